// Decides how the files of the folder are shown: diagrams to open, data to compare with.

import {useState} from 'react';
import {currentPath, useStudio} from '../data/store';
import type {ListedFile} from '../types';

const folderOf = (path: string) => path.slice(0, Math.max(0, path.lastIndexOf('/')));

/// The name of a file in its folder.
export const nameIn = (path: string) => path.slice(path.lastIndexOf('/') + 1);

/// Files by the folders in which they lie, the open folder's own first.
export function byFolder(files: ListedFile[]): {folder: string; files: ListedFile[]}[] {
  const folders = [...new Set(files.map((f) => folderOf(f.path)))].sort();
  return folders.map((folder) => ({folder, files: files.filter((f) => folderOf(f.path) === folder)}));
}

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
        {byFolder(some).map(({folder, files: here}) => (
          <div key={folder}>
            {folder && <h4 className="folder" title={folder}>{folder}</h4>}
            <ul>
              {here.map((f) => (
                <li key={f.path}>
                  <button className={`entry file ${folder ? 'inside' : ''} ${f.path === current ? 'current' : ''}`} data-path={f.path} title={`${f.path}\n${f.title}`} onClick={() => action(f.path)}>
                    <span className="label">{nameIn(f.path)}</span>
                  </button>
                </li>
              ))}
            </ul>
          </div>
        ))}
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
