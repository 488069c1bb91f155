// Decides how the files of the folder are shown: diagrams to open, data to compare with.

import {useState} from 'react';
import {currentPath, useStudio} from '../data/store';

export function Files() {
  const files = useStudio((s) => s.files);
  const open = useStudio((s) => s.open);
  const set = useStudio((s) => s.set);
  const data = useStudio((s) => s.data);
  const path = useStudio(currentPath);
  const [words, setWords] = useState('');
  const list = files.filter((f) => `${f.path} ${f.title}`.toLowerCase().includes(words.toLowerCase()));
  const section = (title: string, kinds: string[], action: (path: string) => void, current: string, empty: string) => {
    const some = list.filter((f) => kinds.includes(f.kind));
    return (
      <section>
        <h3>{title}</h3>
        {some.length === 0 && <p className="empty">{empty}</p>}
        <ul>
          {some.map((f) => (
            <li key={f.path}>
              <button className={`entry file ${f.path === current ? 'current' : ''}`} title={f.title} onClick={() => action(f.path)}>
                <span className="label">{f.path}</span>
              </button>
            </li>
          ))}
        </ul>
      </section>
    );
  };
  return (
    <div className="palette">
      <input className="search" type="search" placeholder="Search files" aria-label="Search files" value={words} onChange={(e) => setWords(e.target.value)} />
      <div className="scroll">
        {section('diagrams', ['diagram'], (p) => void open(p), path, 'No diagram lies here.')}
        {section('data', ['dataset', 'recording'], (p) => set({data: p}), data, 'No recordings lie here: put a CSV with columns such as "t [s],u [V]" into the folder.')}
      </div>
    </div>
  );
}
