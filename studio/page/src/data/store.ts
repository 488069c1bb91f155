// Decides what the page knows: the open diagram, the jobs, and what is selected. Panels read it and call its actions;
// the server's files are the truth, and are looked at again and again.

import {create} from 'zustand';
import {api, Conflict, Refused, type LiveAnswer, type State} from './api';
import {applySplice, emptyHistory, History, isMove, loadHistory, push, pushStep, redoStep, saveHistory, undoStep} from '../edit/history';
import type {Edit, Job, JobOrder, Library, ListedFile, Moves, Problem, Result, Span, View} from '../types';

export type BottomTab = 'scopes' | 'fails' | 'effects' | 'waterfall' | 'diff' | 'text' | 'data' | 'problems';

export interface Trail {
  path: string;
  label: string;
}

interface Studio {
  ready: boolean;
  lost: string;
  folder: string;
  files: ListedFile[];
  catalogue: Library | null;
  trail: Trail[];
  view: View | null;
  document: any;
  depth: number;
  history: History;
  selected: string[];
  selectedWire: string;
  highlighted: string[];
  jobs: Job[];
  results: Record<string, Result>;
  shownJob: string;
  pinnedJobs: string[];
  data: string;
  tab: BottomTab;
  spans: {label: string; spans: Span[]} | null;
  recording: string;
  trial: {job: string; file: string; view: View; title: string; fresh: string[]; edits: Edit[]} | null;
  notice: {text: string; kind: 'note' | 'error'} | null;
  conflict: {text: string; hash: string; mine: string} | null;
  live: (LiveAnswer & {label: string; milliseconds: number}) | null;  // while a number is dragged
  dropped: string[];    // recordings that wait in the tab Data, by their names in the folder
  other: string;        // the diagram with which the open one is compared
  line: number;         // of the text, to be shown; 0: none

  start(): Promise<void>;
  open(path: string, keepTrail?: boolean, label?: string): Promise<void>;
  back(index: number): Promise<void>;
  setDepth(depth: number): Promise<void>;
  reload(): Promise<void>;
  /// Edits as they are, or as they are made of the document when their turn has come: what was on its way has then arrived.
  edit(edits: Edit[] | (() => Edit[])): Promise<boolean>;
  write(text: string): Promise<boolean>;
  move(moves: Moves): Promise<boolean>;
  refresh(): Promise<void>;
  heard(state: State): Promise<void>;
  undo(): Promise<void>;
  redo(): Promise<void>;
  begin(order: JobOrder): Promise<void>;
  show(job: string): Promise<void>;
  cancel(job: string): Promise<void>;
  poll(): Promise<void>;
  set(values: Partial<Studio>): void;
  say(text: string, kind?: 'note' | 'error'): void;
  tell(error: unknown): void;
}

const mostResults = 16;  // that are kept: one that is looked at again is read again

const dataKey = (path: string) => `hysteron.data.${path}`;

function parsed(text: string): any {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

/// The data set that lies nearest to a diagram: in its folder, a set before a single recording.
export function nearestData(path: string, files: ListedFile[]): string {
  const folder = path.slice(0, path.lastIndexOf('/') + 1);
  const here = (kind: string) => files.find((f) => f.kind === kind && f.path.slice(0, f.path.lastIndexOf('/') + 1) === folder);
  return (here('dataset') ?? here('recording'))?.path ?? '';
}

export const currentPath = (s: {trail: Trail[]}) => (s.trail.length ? s.trail[s.trail.length - 1].path : '');

export const useStudio = create<Studio>()((set, get) => {
  const remember = (history: History) => {
    set({history});
    saveHistory(currentPath(get()), history, get().view?.text ?? '');
  };

  /// A view that the server gave: drawn where it can be; else what was drawn before stays, with the problems.
  const take = (view: View) => {
    const before = get().view;
    const sheet = view.sheet ?? before?.sheet ?? null;
    const there = new Set(sheet?.items.map((i) => i.path));
    const selected = get().selected.every((path) => there.has(path)) ? get().selected : get().selected.filter((path) => there.has(path));
    set({view: {...view, sheet}, document: parsed(view.text) ?? get().document, selected});
  };

  const changed = (view: View, record: boolean) => {
    const before = get().view;
    take(view);
    if (record && before && before.text !== view.text) remember(push(get().history, before.text, view.text));
  };

  // One after the other: whoever is quicker than the server does not overtake himself.
  let before: Promise<unknown> = Promise.resolve();
  const inTurn = <T>(action: () => Promise<T>): Promise<T> => {
    const turn = before.then(action);
    before = turn.catch(() => undefined);
    return turn;
  };

  /// `action` is given the text as it is in its turn.
  const guarded = async (action: (now: View) => Promise<View>, record: boolean, mine: string): Promise<boolean> => {
    const now = get().view;
    if (!now) return false;
    try {
      changed(await action(now), record);
      if (record && get().notice?.kind === 'error') set({notice: null});  // what was refused before is past
      return true;
    } catch (error) {
      if (error instanceof Conflict) set({conflict: {text: error.text, hash: error.hash, mine}});
      else get().tell(error);
      return false;
    }
  };

  /// Writes what an undo or redo makes of the text.
  const step = (back: boolean) => inTurn(async () => {
    const {history, view, depth} = get();
    if (!view) return;
    const found = back ? undoStep(history) : redoStep(history);
    if (!found) return;
    const {step} = found;
    if (isMove(step)) {
      if (await guarded(() => api.layout(currentPath(get()), step.after, depth), false, '')) remember(found.history);
      return;
    }
    const text = applySplice(view.text, step);
    if (text === null) {
      set({history: emptyHistory()});
      get().say('the file was changed elsewhere: what was to be undone is not there any more', 'error');
      return;
    }
    if (await guarded(() => api.write(currentPath(get()), text, view.hash, depth), false, text)) remember(found.history);
  });

  return {
    ready: false,
    lost: '',
    folder: '',
    files: [],
    catalogue: null,
    trail: [],
    view: null,
    document: null,
    depth: 0,
    history: emptyHistory(),
    selected: [],
    selectedWire: '',
    highlighted: [],
    jobs: [],
    results: {},
    shownJob: '',
    pinnedJobs: [],
    data: '',
    tab: 'scopes',
    spans: null,
    recording: '',
    trial: null,
    notice: null,
    conflict: null,
    live: null,
    dropped: [],
    other: '',
    line: 0,

    async start() {
      try {
        const [hello, files, catalogue] = await Promise.all([api.hello(), api.files(), api.catalogue()]);
        set({ready: true, folder: hello.name, files, catalogue});
        const remembered = sessionStorage.getItem('hysteron.open');
        const diagrams = files.filter((f) => f.kind === 'diagram');
        const first = diagrams.find((f) => f.path === remembered) ?? diagrams[0];
        if (first) await get().open(first.path);
      } catch (error) {
        set({lost: error instanceof Refused ? error.message : 'the studio does not answer'});
      }
    },

    async open(path, keepTrail = false, label = '') {
      try {
        const view = await api.view(path, get().depth);
        const trail = keepTrail ? [...get().trail, {path, label: label || path}] : [{path, label: path}];
        sessionStorage.setItem('hysteron.open', path);
        set({
          trail,
          view,
          document: parsed(view.text),
          selected: [],
          selectedWire: '',
          highlighted: [],
          trial: null,
          live: null,
          spans: null,
          history: loadHistory(path, view.text),
          data: localStorage.getItem(dataKey(path)) ?? nearestData(path, get().files),
          shownJob: '',
          pinnedJobs: [],
        });
        await get().poll();
        const newest = get().jobs.find((j) => j.diagram === path && j.state === 'done');
        if (newest) await get().show(newest.id);
      } catch (error) {
        get().tell(error);
      }
    },

    async back(index) {
      const trail = get().trail.slice(0, index + 1);
      const last = trail.pop()!;
      set({trail});
      await get().open(last.path, true, last.label);
    },

    async setDepth(depth) {
      set({depth});
      await get().reload();
    },

    reload: () =>
      inTurn(async () => {
        const path = currentPath(get());
        if (path) await guarded(() => api.view(path, get().depth), true, '');
      }),

    edit: (edits) =>
      inTurn(async () => {
        const list = typeof edits === 'function' ? edits() : edits;
        return list.length > 0 && guarded((now) => api.edit(currentPath(get()), list, now.hash, get().depth), true, '');
      }),

    write: (text) => inTurn(() => guarded((now) => api.write(currentPath(get()), text, now.hash, get().depth), true, text)),

    move: (moves) =>
      inTurn(async () => {
        const places = get().view?.places ?? {};
        const before = Object.fromEntries(Object.keys(moves).map((name) => [name, places[name] ?? null]));
        if (!(await guarded(() => api.layout(currentPath(get()), moves, get().depth), false, ''))) return false;
        remember(pushStep(get().history, {before, after: moves}));
        return true;
      }),

    async refresh() {
      try {
        set({files: await api.files()});
      } catch (error) {
        get().tell(error);
      }
    },

    undo: () => step(true),
    redo: () => step(false),

    async begin(order) {
      try {
        const id = await api.begin(order);
        set({shownJob: id});
        await get().poll();
      } catch (error) {
        get().tell(error);
      }
    },

    async show(id) {
      const job = get().jobs.find((j) => j.id === id);
      if (!job) return;
      if (job.state === 'done' && !get().results[id]) {
        try {
          const result = JSON.parse(await api.read(`${job.folder}/result.json`)) as Result;
          const others = Object.entries(get().results).slice(1 - mostResults);
          set({results: {...Object.fromEntries(others), [id]: result}});
        } catch (error) {
          get().tell(error);
        }
      }
      const tab: Partial<Record<string, BottomTab>> = {run: 'scopes', compare: 'fails', diagnose: 'effects', discover: 'effects'};
      const result = get().results[id];
      const known = result?.traces.includes(get().recording);
      set({shownJob: id, tab: tab[job.verb] ?? get().tab, spans: null, recording: known ? get().recording : result?.traces[0] ?? ''});
    },

    async cancel(id) {
      try {
        await api.cancel(id);
      } catch (error) {
        get().tell(error);
      }
      await get().poll();
    },

    async heard(state) {
      const path = currentPath(get());
      const before = get().jobs;
      set({jobs: state.jobs, lost: ''});
      await inTurn(async () => undefined);  // an edit of ours that is on its way is no edit of others
      if (path && state.files[path] && get().view && state.files[path] !== get().view!.hash && !get().conflict) await get().reload();
      const shown = state.jobs.find((j) => j.id === get().shownJob);
      const was = before.find((j) => j.id === get().shownJob);
      // A quick job may be told as done before it is known to be the one that is shown.
      if (shown && shown.state === 'done' && (was?.state !== 'done' || !get().results[shown.id])) await get().show(shown.id);
      if (shown && shown.state === 'failed' && was && was.state !== 'failed') set({tab: 'problems'});
    },

    async poll() {
      const path = currentPath(get());
      try {
        await get().heard(await api.state(path ? [path] : []));
      } catch (error) {
        set({lost: error instanceof Refused ? error.message : 'the studio does not answer: it was ended, or is being started anew'});
      }
    },

    set: (values) => {
      if (values.data !== undefined) localStorage.setItem(dataKey(currentPath(get())), values.data);
      set(values);
    },
    say: (text, kind = 'note') => set({notice: {text, kind}}),
    tell(error) {
      const problems: Problem[] = error instanceof Refused ? error.problems : [];
      get().say(problems.length ? problems.map((p) => `${p.what}: ${p.cure}`).join('\n') : String(error), 'error');
    },
  };
});

const patience = 800;  // [ms] before a server that has gone is asked again

/// Hears of changed files and jobs as long as somebody sees the page: one stream, begun anew for another diagram. A page
/// in the background lets go of it, since a browser holds six connections for all of its pages.
export function keepListening(): () => void {
  let ended = false;
  let stream = new AbortController();
  const listen = async () => {
    while (!ended) {
      stream = new AbortController();
      const path = currentPath(useStudio.getState());
      try {
        if (document.hidden) await new Promise((seen) => document.addEventListener('visibilitychange', seen, {once: true}));
        else await api.events(path ? [path] : [], (state) => void useStudio.getState().heard(state), stream.signal);
      } catch {
        if (!ended && !stream.signal.aborted) await useStudio.getState().poll();  // which tells where the server has gone
      }
      if (!ended && !stream.signal.aborted) await new Promise((r) => setTimeout(r, patience));
    }
  };
  const leave = () => document.hidden && stream.abort();
  const unsubscribe = useStudio.subscribe((now, before) => {
    if (currentPath(now) !== currentPath(before)) stream.abort();
  });
  document.addEventListener('visibilitychange', leave);
  void listen();
  return () => {
    ended = true;
    unsubscribe();
    document.removeEventListener('visibilitychange', leave);
    stream.abort();
  };
}
