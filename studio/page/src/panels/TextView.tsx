// Decides how the file is edited as text: all of it, saved by Ctrl+S, with its problems where they stand.

import {useEffect, useRef, useState} from 'react';
import {currentPath, useStudio} from '../data/store';
import type {Editor} from './CodeEditor';

const drafts = new Map<string, string>();  // typed and not saved, while another tab is looked at

export function TextView() {
  const view = useStudio((s) => s.view);
  const write = useStudio((s) => s.write);
  const goTo = useStudio((s) => s.line);
  const holder = useRef<HTMLDivElement>(null);
  const editor = useRef<Editor | null>(null);
  const base = useRef('');
  const path = useStudio(currentPath);
  const openPath = useRef(path);
  const [ready, setReady] = useState(false);
  const [isChanged, setChanged] = useState(false);
  const look = () => setChanged(editor.current !== null && editor.current.text() !== base.current);
  const save = () => {
    const text = editor.current?.text() ?? base.current;
    if (text !== base.current) void write(text);
  };
  useEffect(() => {
    let wanted = true;
    openPath.current = path;
    void import('./CodeEditor').then(({makeEditor}) => {
      if (!wanted || !holder.current) return;
      const path = currentPath(useStudio.getState());
      base.current = useStudio.getState().view?.text ?? '';
      const draft = drafts.get(path);
      drafts.delete(path);
      editor.current = makeEditor(holder.current, draft ?? base.current, {
        onChange: look,
        onSave: save,
        known: () => ({document: useStudio.getState().document, blocks: useStudio.getState().catalogue?.blocks ?? []}),
      });
      setReady(true);
      look();
    });
    return () => {
      wanted = false;
      if (editor.current && editor.current.text() !== base.current) drafts.set(openPath.current, editor.current.text());
      editor.current?.destroy();
      editor.current = null;
    };
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [path]);
  useEffect(() => {
    if (!view || !editor.current) return;
    // What was typed and not saved stays where the file changes elsewhere; saving then shows the conflict.
    if (editor.current.text() === base.current) editor.current.setText(view.text);
    base.current = view.text;
    look();
    editor.current.tell(view.problems);
  }, [view, ready]);
  useEffect(() => {
    if (!goTo || !editor.current) return;
    editor.current.goTo(goTo);
    useStudio.getState().set({line: 0});
  }, [goTo, ready]);
  if (!view) return null;
  return (
    <>
      <div className="panel-head">
        <span className="headline">{isChanged ? 'not saved' : 'as in the file'}</span>
        <button disabled={!isChanged} onClick={() => { editor.current?.setText(base.current); look(); }}>Revert</button>
        <button className="primary" disabled={!isChanged} onClick={save}>Save</button>
      </div>
      <div className="text-view" ref={holder} />
    </>
  );
}
