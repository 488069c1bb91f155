// Decides how the page speaks with its server. The token comes in the fragment of the address, which browsers send to
// nobody; it is taken out of the address bar and kept for reloads of this tab.

import type {Edit, Job, JobOrder, Library, ListedFile, Moves, Options, Problem, RecordingPreview, TraceHead, View} from '../types';
import {toldOf, viewOf, type Told, type ToldReply} from './told';

const tokenKey = 'hysteron.token';

function takeToken(): string {
  const given = new URLSearchParams(location.hash.slice(1)).get('token');
  if (given) {
    sessionStorage.setItem(tokenKey, given);
    history.replaceState(null, '', location.pathname);
  }
  return given ?? sessionStorage.getItem(tokenKey) ?? '';
}

const token = takeToken();

/// What the server refuses, in its own words.
export class Refused extends Error {
  constructor(readonly status: number, readonly problems: Problem[]) {
    super(problems.map((p) => p.what).join('; '));
  }
}

/// The file was changed by somebody else in the meantime.
export class Conflict extends Error {
  constructor(readonly text: string, readonly hash: string) {
    super('the file was changed in the meantime');
  }
}

async function ask(method: string, path: string, body?: unknown, signal?: AbortSignal): Promise<Response> {
  const raw = body instanceof Blob;
  const reply = await fetch(path, {
    method,
    headers: {Authorization: `Bearer ${token}`, ...(body === undefined || raw ? {} : {'Content-Type': 'application/json'})},
    body: body === undefined ? undefined : raw ? body : JSON.stringify(body),
    signal,
  });
  if (reply.ok) return reply;
  const told = await reply.json().catch(() => ({}));
  if (reply.status === 409) throw new Conflict(told.text, told.hash);
  throw new Refused(reply.status, told.problems ?? [{code: 'no_answer', path, what: reply.statusText, cure: ''}]);
}

const json = async <T>(method: string, path: string, body?: unknown): Promise<T> => (await ask(method, path, body)).json();
const query = (values: Record<string, string | number | string[]>) => {
  const words = new URLSearchParams();
  for (const [name, value] of Object.entries(values))
    for (const one of Array.isArray(value) ? value : [value]) words.append(name, String(one));
  return words.toString();
};

let told: Told | null = null;

/// A view of a diagram; of what the server told before only the difference is sent.
async function view(method: string, path: string, body: object): Promise<View> {
  const had = told;
  told = toldOf(had, await json<ToldReply>(method, path, {...body, had: had?.id ?? ''}));
  return viewOf(told);
}

/// Smallest and largest value of each column per pixel.
export interface Stretch {
  x: Float64Array;
  columns: {name: string; low: Float64Array; high: Float64Array}[];
}

/// n, then n times, then for each column n smallest and n largest values.
function stretchOf(numbers: Float64Array, columns: string[]): Stretch {
  const n = numbers[0];
  const part = (k: number) => numbers.subarray(1 + k * n, 1 + (k + 1) * n);
  return {x: part(0), columns: columns.map((name, i) => ({name, low: part(1 + 2 * i), high: part(2 + 2 * i)}))};
}

/// What a diagram would do with other numbers.
export interface LiveAnswer {
  headline: string;
  facts: any;
  trace: string;
  traces: string[];
  rows: number;
  stretch: Stretch;
}

export interface LiveOrder extends JobOrder {
  other?: string;     // a second file of traces
  patience?: number;  // [ms]
  trace: string;
  columns: string[];
  from: number;
  to: number;
  pixels: number;
}

export interface State {
  files: Record<string, string>;
  jobs: Job[];
}

export const api = {
  hello: () => json<{version: string; folder: string; name: string; threads: number}>('GET', '/api/hello'),
  files: async () => (await json<{files: ListedFile[]}>('GET', '/api/files')).files,
  catalogue: () => json<Library>('GET', '/api/blocks'),
  state: (paths: string[]) =>
    json<State>('GET', `/api/state?${query({path: paths})}`),
  /// Tells of each change of these files and of the jobs, until it is ended.
  async events(paths: string[], told: (state: State) => void, ended: AbortSignal): Promise<void> {
    const reply = await ask('GET', `/api/events?${query({path: paths})}`, undefined, ended);
    const reader = reply.body!.pipeThrough(new TextDecoderStream()).getReader();
    for (let rest = '';;) {
      const {done, value} = await reader.read();
      if (done) return;
      const lines = (rest + value).split('\n');
      rest = lines.pop()!;
      for (const line of lines) if (line) told(JSON.parse(line));
    }
  },
  layout: (path: string, moves: Moves, depth: number) => view('POST', '/api/layout', {path, moves, depth}),
  upload: async (file: File) => (await json<{file: string}>('POST', `/api/upload?${query({name: file.name})}`, file)).file,
  preview: (file: string, options: Options) => json<RecordingPreview>('POST', '/api/import/preview', {file, options}),
  startFrom: (files: string[], options: Options, folder: string) =>
    json<{diagram: string; dataset: string; assumed: string[]; words: string[]}>('POST', '/api/import', {files, options, folder}),
  join: (file: string, options: Options, dataset: string, role: string) =>
    json<{recording: string}>('POST', '/api/import/join', {file, options, dataset, role}),
  async live(order: LiveOrder): Promise<LiveAnswer> {
    const bytes = await (await ask('POST', '/api/live', order)).arrayBuffer();
    const length = new Float64Array(bytes, 0, 1)[0];
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, length)));
    const columns = head.columns.map((c: {name: string}) => c.name);
    return {headline: head.headline, facts: head.facts, trace: head.trace, traces: head.traces, rows: head.rows, stretch: stretchOf(new Float64Array(bytes, 8 + length), columns)};
  },
  view: (path: string, depth: number) => view('POST', '/api/view', {path, depth}),
  fits: (path: string, signal: string) =>
    json<{item: number; in: number; why: string}[]>('POST', '/api/fits', {path, signal}),
  read: async (path: string) => (await ask('GET', `/api/file?${query({path})}`)).text(),
  write: (path: string, text: string, hash: string, depth: number) =>
    view('PUT', '/api/file', {path, text, hash, depth}),
  edit: (path: string, edits: Edit[], hash: string, depth: number) =>
    view('POST', '/api/edit', {path, edits, hash, depth}),
  begin: async (order: JobOrder) => (await json<{id: string}>('POST', '/api/jobs', order)).id,
  cancel: (id: string) => json('POST', '/api/cancel', {id}),
  remove: (id: string) => json('DELETE', `/api/jobs?${query({id})}`),
  head: (path: string) => json<TraceHead>('GET', `/api/head?${query({path})}`),
  units: (of: string) => json<{text: string}[]>('GET', `/api/units?${query({of})}`),
  ticket: async (path: string) => (await json<{url: string}>('POST', '/api/ticket', {path})).url,
  async trace(path: string, columns: string[], from: number, to: number, pixels: number): Promise<Stretch> {
    const reply = await ask('GET', `/api/trace?${query({path, column: columns, from, to, pixels})}`);
    return stretchOf(new Float64Array(await reply.arrayBuffer()), columns);
  },
};
