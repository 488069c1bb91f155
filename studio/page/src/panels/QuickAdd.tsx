// Decides what "/" does on the canvas: a few letters, Enter, and the block stands there, wired to the selection.

import {useEffect, useMemo, useRef, useState} from 'react';
import {useStudio} from '../data/store';
import {place} from '../edit/actions';
import {found} from '../edit/search';
import {Icon} from './Palette';

const most = 9;

export function QuickAdd({onClose}: {onClose: () => void}) {
  const catalogue = useStudio((s) => s.catalogue)!;
  const selected = useStudio((s) => s.selected);
  const [words, setWords] = useState('');
  const [at, setAt] = useState(0);
  const field = useRef<HTMLInputElement>(null);
  const list = useMemo(() => found(catalogue.blocks, words).slice(0, most), [catalogue, words]);
  useEffect(() => field.current?.focus(), []);
  const take = (type: string) => {
    onClose();
    void place(type);
  };
  return (
    <div className="quick" role="dialog" aria-label="add a block">
      <input ref={field} value={words} placeholder={selected[0] ? `Add a block behind ${selected[0]}` : 'Add a block'} aria-label="name of the block"
             onChange={(e) => { setWords(e.target.value); setAt(0); }} onBlur={() => window.setTimeout(onClose, 150)}
             onKeyDown={(e) => {
               e.stopPropagation();
               if (e.key === 'Escape') onClose();
               if (e.key === 'ArrowDown') setAt(Math.min(at + 1, list.length - 1));
               if (e.key === 'ArrowUp') setAt(Math.max(at - 1, 0));
               if (e.key === 'Enter' && list[at]) take(list[at].type);
             }} />
      <ul>
        {list.map((b, i) => (
          <li key={b.type}>
            <button className={i === at ? 'entry current' : 'entry'} onMouseDown={() => take(b.type)}>
              <Icon item={catalogue.symbols[b.type]} pictures={catalogue.pictures} /><span className="label">{b.type}</span><span className="muted">{b.summary}</span>
            </button>
          </li>
        ))}
      </ul>
    </div>
  );
}
