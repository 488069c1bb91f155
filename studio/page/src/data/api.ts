// Decides how the page speaks with its server. The token comes in the fragment of the address, which browsers send to
// nobody; it is taken out of the address bar and kept for reloads of this tab.

import type {Edit, Job, JobOrder, Library, ListedFile, Problem, TraceHead, View} from '../types';

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

async function ask(method: string, path: string, body?: unknown): Promise<Response> {
  const reply = await fetch(path, {
    method,
    headers: {Authorization: `Bearer ${token}`, ...(body === undefined ? {} : {'Content-Type': 'application/json'})},
    body: body === undefined ? undefined : JSON.stringify(body),
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

/// Smallest and largest value of each column per pixel.
export interface Stretch {
  x: Float64Array;
  columns: {name: string; low: Float64Array; high: Float64Array}[];
}

export const api = {
  hello: () => json<{version: string; folder: string; name: string; threads: number}>('GET', '/api/hello'),
  files: async () => (await json<{files: ListedFile[]}>('GET', '/api/files')).files,
  catalogue: () => json<Library>('GET', '/api/blocks'),
  state: (paths: string[]) =>
    json<{files: Record<string, string>; jobs: Job[]}>('GET', `/api/state?${query({path: paths})}`),
  view: (path: string, depth: number) => json<View>('POST', '/api/view', {path, depth}),
  fits: (path: string, signal: string) =>
    json<{item: number; in: number; why: string}[]>('POST', '/api/fits', {path, signal}),
  read: async (path: string) => (await ask('GET', `/api/file?${query({path})}`)).text(),
  write: (path: string, text: string, hash: string, depth: number) =>
    json<View>('PUT', '/api/file', {path, text, hash, depth}),
  edit: (path: string, edits: Edit[], hash: string, depth: number) =>
    json<View>('POST', '/api/edit', {path, edits, hash, depth}),
  begin: async (order: JobOrder) => (await json<{id: string}>('POST', '/api/jobs', order)).id,
  cancel: (id: string) => json('POST', '/api/cancel', {id}),
  remove: (id: string) => json('DELETE', `/api/jobs?${query({id})}`),
  head: (path: string) => json<TraceHead>('GET', `/api/head?${query({path})}`),
  units: (of: string) => json<{text: string}[]>('GET', `/api/units?${query({of})}`),
  ticket: async (path: string) => (await json<{url: string}>('POST', '/api/ticket', {path})).url,
  async trace(path: string, columns: string[], from: number, to: number, pixels: number): Promise<Stretch> {
    const reply = await ask('GET', `/api/trace?${query({path, column: columns, from, to, pixels})}`);
    const numbers = new Float64Array(await reply.arrayBuffer());
    const n = numbers[0];
    const part = (k: number) => numbers.subarray(1 + k * n, 1 + (k + 1) * n);
    return {x: part(0), columns: columns.map((name, i) => ({name, low: part(1 + 2 * i), high: part(2 + 2 * i)}))};
  },
};
