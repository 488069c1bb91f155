// Decides how the file is edited as text: all of it, saved by Ctrl+S, with the lines of its problems.

import {useEffect, useRef, useState} from 'react';
import {useStudio} from '../data/store';

export function TextView() {
  const view = useStudio((s) => s.view);
  const write = useStudio((s) => s.write);
  const [text, setText] = useState('');
  const [base, setBase] = useState('');
  const numbers = useRef<HTMLDivElement>(null);
  const area = useRef<HTMLTextAreaElement>(null);
  useEffect(() => {
    if (!view) return;
    // What was typed and not saved stays where the file changes elsewhere; saving then shows the conflict.
    if (text === base) setText(view.text);
    setBase(view.text);
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [view]);
  if (!view) return null;
  const wrong = new Set(view.problems.map((p) => p.line).filter(Boolean));
  const lines = text.split('\n').length;
  const save = () => text !== base && void write(text);
  return (
    <>
      <div className="panel-head">
        <span className="headline">{text === base ? 'as in the file' : 'not saved'}</span>
        <button disabled={text === base} onClick={() => setText(base)}>Revert</button>
        <button className="primary" disabled={text === base} onClick={save}>Save</button>
      </div>
      <div className="text-view">
        <div className="line-numbers" ref={numbers} aria-hidden>
          {Array.from({length: lines}, (_, i) => <div key={i} className={wrong.has(i + 1) ? 'wrong' : ''}>{i + 1}</div>)}
        </div>
        <textarea ref={area} aria-label="text of the file" spellCheck={false} wrap="off" value={text} onChange={(e) => setText(e.target.value)}
                  onScroll={(e) => numbers.current && (numbers.current.scrollTop = e.currentTarget.scrollTop)}
                  onKeyDown={(e) => {
                    if ((e.ctrlKey || e.metaKey) && e.key === 's') {
                      e.preventDefault();
                      save();
                    }
                    e.stopPropagation();
                  }} />
      </div>
    </>
  );
}
