// Decides how the page is divided, and which keys do what.

import {useEffect, useState} from 'react';
import {Canvas} from './canvas/Canvas';
import {currentPath, keepListening, useStudio, type BottomTab} from './data/store';
import * as actions from './edit/actions';
import {differingLines} from './edit/changes';
import {Data, takeIn} from './panels/Data';
import {Diff} from './panels/Diff';
import {Effects} from './panels/Effects';
import {Fails} from './panels/Fails';
import {byFolder, Files, nameIn} from './panels/Files';
import {Inspector} from './panels/Inspector';
import {JobsMenu} from './panels/JobsMenu';
import {Palette} from './panels/Palette';
import {Problems} from './panels/Problems';
import {QuickAdd} from './panels/QuickAdd';
import {Scopes} from './panels/Scopes';
import {orderOf} from './panels/StartHint';
import {TextView} from './panels/TextView';
import {Waterfall} from './panels/Waterfall';

const verbs: {verb: string; label: string; tip: string; data: boolean}[] = [
  {verb: 'run', label: 'Run', tip: 'simulate the diagram (Ctrl+Enter)', data: false},
  {verb: 'compare', label: 'Compare', tip: 'how far is the model from the recordings, and where', data: true},
  {verb: 'diagnose', label: 'Diagnose', tip: 'which effect is missing: looked for, nothing added', data: true},
  {verb: 'discover', label: 'Discover', tip: 'find what is missing, add it, fit it', data: true},
];

const tabs: {tab: BottomTab; label: string}[] = [
  {tab: 'scopes', label: 'Scopes'}, {tab: 'fails', label: 'Where it fails'}, {tab: 'effects', label: 'Effects'},
  {tab: 'waterfall', label: 'Waterfall'}, {tab: 'diff', label: 'Diff'}, {tab: 'text', label: 'Text'}, {tab: 'data', label: 'Data'}, {tab: 'problems', label: 'Problems'},
];

function useTheme(): [string, () => void] {
  const [theme, setTheme] = useState(() => localStorage.getItem('hysteron.theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  return [theme, () => {
    const next = theme === 'dark' ? 'light' : 'dark';
    localStorage.setItem('hysteron.theme', next);
    setTheme(next);
  }];
}

function TopBar() {
  const {begin, undo, redo, back, setDepth, set} = useStudio.getState();
  const trail = useStudio((s) => s.trail);
  const path = useStudio(currentPath);
  const data = useStudio((s) => s.data);
  const files = useStudio((s) => s.files);
  const history = useStudio((s) => s.history);
  const depth = useStudio((s) => s.depth);
  const [theme, toggle] = useTheme();
  const dataFiles = files.filter((f) => f.kind === 'dataset' || f.kind === 'recording');
  return (
    <header className="topbar">
      <span className="brand">hysteron</span>
      <nav className="crumbs" aria-label="open diagrams">
        {trail.map((t, i) => (
          <span key={i}>{i > 0 && <span className="muted"> › </span>}
            {i < trail.length - 1 ? <button className="quiet" onClick={() => void back(i)}>{t.label}</button> : <b title={t.path}>{t.label}</b>}</span>
        ))}
      </nav>
      <div className="group" role="toolbar" aria-label="verbs">
        {verbs.map((v) => (
          <button key={v.verb} className={v.verb === 'run' ? 'primary' : ''} title={v.data && !data ? `${v.tip}; choose data first` : v.tip} disabled={!path || (v.data && !data)}
                  onClick={() => void begin(orderOf(v.verb, path, data, useStudio.getState().document))}>{v.label}</button>
        ))}
      </div>
      <label className="with-data">with <select aria-label="data" value={data} onChange={(e) => set({data: e.target.value})}>
        <option value="">no data</option>
        {byFolder(dataFiles).map(({folder, files: some}) => folder === '' ? some.map((f) => <option key={f.path}>{f.path}</option>) : (
          <optgroup key={folder} label={folder}>{some.map((f) => <option key={f.path} value={f.path}>{nameIn(f.path)}</option>)}</optgroup>
        ))}
      </select></label>
      <span className="space" />
      <div className="group">
        <button className="icon-button" title="undo (Ctrl+Z)" aria-label="undo" disabled={history.done.length === 0} onClick={() => void undo()}>↶</button>
        <button className="icon-button" title="redo (Ctrl+Y)" aria-label="redo" disabled={history.undone.length === 0} onClick={() => void redo()}>↷</button>
      </div>
      <button title="open nested diagrams in place" className={depth > 0 ? 'on' : ''} aria-pressed={depth > 0} onClick={() => void setDepth(depth > 0 ? 0 : 2)}>Nested</button>
      <JobsMenu />
      <button className="icon-button" title={theme === 'dark' ? 'light' : 'dark'} aria-label="dark or light" onClick={toggle}>{theme === 'dark' ? '☀' : '☾'}</button>
    </header>
  );
}

function Left() {
  const [tab, setTab] = useState<'blocks' | 'files'>('blocks');
  return (
    <aside className="sidebar" aria-label="blocks and files">
      <div className="tabs">
        <button className={tab === 'blocks' ? 'on' : ''} onClick={() => setTab('blocks')}>Blocks</button>
        <button className={tab === 'files' ? 'on' : ''} onClick={() => setTab('files')}>Files</button>
      </div>
      {tab === 'blocks' ? <Palette /> : <Files />}
    </aside>
  );
}

function Bottom() {
  const tab = useStudio((s) => s.tab);
  const set = useStudio((s) => s.set);
  const view = useStudio((s) => s.view);
  const waiting = useStudio((s) => s.dropped.length);
  const failed = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob)?.state === 'failed');
  const count = (view?.problems.length ?? 0) + (failed ? 1 : 0);
  const [height, setHeight] = useState(() => Number(localStorage.getItem('hysteron.bottom')) || Math.max(300, Math.round(0.4 * window.innerHeight)));
  const drag = (down: React.PointerEvent) => {
    const start = down.clientY + height;
    const move = (e: PointerEvent) => {
      const next = Math.min(Math.max(start - e.clientY, 36), window.innerHeight - 160);
      localStorage.setItem('hysteron.bottom', String(next));
      setHeight(next);
    };
    const up = () => {
      window.removeEventListener('pointermove', move);
      window.removeEventListener('pointerup', up);
    };
    window.addEventListener('pointermove', move);
    window.addEventListener('pointerup', up);
  };
  return (
    <section className="results" style={{height}} aria-label="results">
      <div className="resize" onPointerDown={drag} role="separator" aria-orientation="horizontal" />
      <div className="tabs">
        {tabs.map((t) => (
          <button key={t.tab} className={tab === t.tab ? 'on' : ''} onClick={() => set({tab: t.tab})}>
            {t.label}{t.tab === 'problems' && count > 0 && <span className="count">{count}</span>}
            {t.tab === 'data' && waiting > 0 && <span className="count waiting">{waiting}</span>}
          </button>
        ))}
      </div>
      <div className="panel">
        {tab === 'scopes' && <Scopes />}
        {tab === 'fails' && <Fails />}
        {tab === 'effects' && <Effects />}
        {tab === 'waterfall' && <Waterfall />}
        {tab === 'diff' && <Diff />}
        {tab === 'text' && <TextView />}
        {tab === 'data' && <Data />}
        {tab === 'problems' && <Problems />}
      </div>
    </section>
  );
}

function Banners() {
  const {notice, conflict, trial, lost, set, reload, view} = useStudio();
  useEffect(() => {
    if (!notice || notice.kind === 'error') return;
    const timer = window.setTimeout(() => set({notice: null}), 4000);
    return () => clearTimeout(timer);
  }, [notice, set]);
  return (
    <div className="banners" aria-live="polite">
      {lost && <div className="banner error">{lost}</div>}
      {trial && <div className="banner trial">Shown: the diagram with {trial.title.replace(/_/g, ' ')}, not yet written. <button className="primary" onClick={() => void actions.accept()}>Accept</button> <button onClick={() => set({trial: null})}>Discard</button></div>}
      {conflict && (
        <div className="banner error">
          The file was changed by somebody else while you edited.
          {conflict.mine && differingLines(conflict.text, conflict.mine).map((lines, i) => <div key={i} className="side"><span>{i === 0 ? 'theirs' : 'mine'}</span><pre>{lines}</pre></div>)}
          <button onClick={() => { set({conflict: null}); void reload(); }}>Take theirs</button>
          {conflict.mine && <button onClick={() => { set({conflict: null, view: {...view!, hash: conflict.hash}}); void useStudio.getState().write(conflict.mine); }}>Write mine over it</button>}
        </div>
      )}
      {notice && <div className={`banner ${notice.kind}`}>{notice.text} <button className="quiet small" aria-label="close" onClick={() => set({notice: null})}>×</button></div>}
    </div>
  );
}

/// Keys of a field of text are its own; of a list of choices and a box to tick only those without Ctrl.
function isTyping(e: KeyboardEvent | ClipboardEvent): boolean {
  const {tagName, type} = e.target as HTMLInputElement;
  const isText = tagName === 'TEXTAREA' || (tagName === 'INPUT' && type !== 'checkbox');
  return isText || (tagName === 'SELECT' && e instanceof KeyboardEvent && !e.ctrlKey && !e.metaKey);
}

function useKeys(add: () => void) {
  useEffect(() => {
    const key = (e: KeyboardEvent) => {
      const {undo, redo, begin, data, document, set} = useStudio.getState();
      const command = e.ctrlKey || e.metaKey;
      if (command && e.key === 'Enter') return void begin(orderOf('run', currentPath(useStudio.getState()), data, document));
      if (isTyping(e)) return;
      if (command && e.key.toLowerCase() === 'z') {
        e.preventDefault();
        return void (e.shiftKey ? redo() : undo());
      }
      if (command && e.key.toLowerCase() === 'y') {
        e.preventDefault();
        return void redo();
      }
      if (command && e.key.toLowerCase() === 'c') return void actions.copy();
      if (e.key === 'Delete' || e.key === 'Backspace') return void actions.removeSelected();
      if (e.key === 'Escape') set({selected: [], selectedWire: '', trial: null});
      if (e.key === '/') {
        e.preventDefault();
        add();
      }
    };
    const paste = (e: ClipboardEvent) => {
      if (isTyping(e)) return;
      const text = e.clipboardData?.getData('text/plain');
      if (text) void actions.paste(text);
    };
    window.addEventListener('keydown', key);
    window.addEventListener('paste', paste);
    return () => {
      window.removeEventListener('keydown', key);
      window.removeEventListener('paste', paste);
    };
  }, [add]);
}

/// Recordings that are dragged over the page: dropped anywhere, they are looked at.
function useDrops(): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    const holdsFiles = (e: DragEvent) => [...(e.dataTransfer?.types ?? [])].includes('Files');
    const move = (e: DragEvent) => {
      if (!holdsFiles(e)) return;
      e.preventDefault();
      setOver(true);
    };
    const leave = (e: DragEvent) => e.relatedTarget === null && setOver(false);
    const drop = (e: DragEvent) => {
      if (!holdsFiles(e)) return;
      e.preventDefault();
      setOver(false);
      void takeIn([...(e.dataTransfer?.files ?? [])]);
    };
    window.addEventListener('dragover', move);
    window.addEventListener('dragleave', leave);
    window.addEventListener('drop', drop);
    return () => {
      window.removeEventListener('dragover', move);
      window.removeEventListener('dragleave', leave);
      window.removeEventListener('drop', drop);
    };
  }, []);
  return over;
}

/// A file that cannot be drawn at all: why, and where that is told.
function Undrawn() {
  const problems = useStudio((s) => s.view?.problems ?? []);
  const set = useStudio((s) => s.set);
  return (
    <div className="cover">
      <p>This file cannot be drawn yet: {problems[0]?.what ?? 'it is no diagram'}.</p>
      {problems[0]?.cure && <p className="muted">{problems[0].cure}</p>}
      <button onClick={() => set({tab: 'problems'})}>{problems.length === 1 ? 'Show where' : `Show all ${problems.length}`}</button>
    </div>
  );
}

export function App() {
  const ready = useStudio((s) => s.ready);
  const lost = useStudio((s) => s.lost);
  const view = useStudio((s) => s.view);
  const [adding, setAdding] = useState(false);
  const over = useDrops();
  useKeys(() => setAdding(true));
  useEffect(() => {
    void useStudio.getState().start();
    return keepListening();
  }, []);
  if (!ready) return <main className="cover">{lost && <><p>{lost}.</p><p className="muted">Open the address that hysteron studio printed: it holds the token.</p></>}</main>;
  return (
    <div className="frame">
      <TopBar />
      <Left />
      <main className="canvas" aria-label="diagram">
        <Canvas />
        {view && !view.sheet && <Undrawn />}
        {!view && <div className="cover"><p>No diagram lies in this folder.</p><p className="muted">Drop a recording here: it is looked at, and makes one.</p></div>}
        {adding && <QuickAdd onClose={() => setAdding(false)} />}
        <Banners />
      </main>
      <Inspector />
      <Bottom />
      {over && <div className="drop-here"><p>Drop recordings to look at them</p></div>}
    </div>
  );
}
