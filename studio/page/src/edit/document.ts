// Decides which text edits a gesture is: what a block, a wire, a value is in the file. Plain functions of the document
// and the declarations; nothing is sent from here.

import type {BlockDeclaration, Edit, Item} from '../types';

export const pointer = (...keys: (string | number)[]) => keys.map((k) => `/${String(k).replace(/~/g, '~0').replace(/\//g, '~1')}`).join('');

/// Values as diagrams write them: one line, a blank behind colons and commas.
export function jsonText(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(jsonText).join(', ')}]`;
  if (value !== null && typeof value === 'object') {
    const members = Object.entries(value).filter(([, v]) => v !== undefined);
    return `{${members.map(([k, v]) => `${JSON.stringify(k)}: ${jsonText(v)}`).join(', ')}}`;
  }
  return JSON.stringify(value);
}

/// What was typed as a value: a number stays a number, JSON stays JSON, a list may be followed by its unit ("[1, 2] ms"),
/// all else is text ("5 Hz", "$kp").
export function typedValue(text: string): unknown {
  const trimmed = text.trim();
  const list = /^(\[.*\])\s*([^\s,[\]][^[\]]*)$/.exec(trimmed);
  if (list) {
    try {
      return {value: JSON.parse(list[1]), unit: list[2]};
    } catch {
      return trimmed;
    }
  }
  if (/^[[{"]/.test(trimmed)) {
    try {
      return JSON.parse(trimmed);
    } catch {
      return trimmed;
    }
  }
  if (/^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/.test(trimmed)) return Number(trimmed);
  return trimmed;
}

/// A value as it is shown in a field.
export function shownValue(value: unknown): string {
  if (value === undefined) return '';
  if (value !== null && typeof value === 'object' && !Array.isArray(value)) {
    const v = value as {value?: unknown; unit?: string};
    const isPlain = Object.keys(v).every((key) => key === 'value' || key === 'unit');
    if (typeof v.value === 'number') return v.unit ? `${v.value} ${v.unit}` : String(v.value);
    if (Array.isArray(v.value) && v.unit && isPlain) return `${jsonText(v.value)} ${v.unit}`;
  }
  return typeof value === 'string' ? value : jsonText(value);
}

const topLevel = ['$schema', 'format', 'title', 'source', 'remark', 'parameters', 'inputs', 'blocks', 'outputs', 'record', 'places', 'simulate'];

/// The member of the document behind which a new one of this name belongs.
export function predecessor(document: any, key: string): string {
  const before = topLevel.slice(0, topLevel.indexOf(key)).filter((k) => document && k in document);
  return before[before.length - 1] ?? '';
}

/// Puts a member into an object of the document that may not be there yet.
export function putInto(document: any, section: string, key: string, value: unknown): Edit {
  if (document?.[section] && typeof document[section] === 'object') {
    if (key in document[section]) return {kind: 'replace', pointer: pointer(section, key), value: jsonText(value)};
    return {kind: 'insert', pointer: pointer(section), key, value: jsonText(value)};
  }
  return {kind: 'insert', pointer: '', key: section, value: jsonText({[key]: value}), after: predecessor(document, section)};
}

/// "gain", else "gain_2", "gain_3" ...: a name that neither a block nor an input has.
export function freeName(document: any, wanted: string): string {
  const taken = new Set([...Object.keys(document?.blocks ?? {}), ...Object.keys(document?.inputs ?? {})]);
  if (!taken.has(wanted)) return wanted;
  let n = 2;
  while (taken.has(`${wanted}_${n}`)) ++n;
  return `${wanted}_${n}`;
}

const unitless = /\$/;

/// A new block with what its type cannot do without: numbers of 1 in the declared unit, the first of several words.
export function newBlock(declaration: BlockDeclaration): Record<string, unknown> {
  const block: Record<string, unknown> = {type: declaration.type};
  for (const p of declaration.parameters) {
    if (p.default !== null) continue;
    const one = p.unit && !unitless.test(p.unit) ? `1 ${p.unit}` : 1;
    if (p.kind === 'number') block[p.name] = one;
    else if (p.kind === 'list') block[p.name] = [one];
    else if (p.kind === 'matrix') block[p.name] = [[one]];
    else if (p.kind === 'text' && p.choices.length) block[p.name] = p.choices[0];
  }
  return block;
}

/// The signal that an output carries, as files write it.
export const signalName = (item: Item, out: number) =>
  item.type === 'input' || item.out.length === 1 ? item.name : `${item.name}.${item.out[out].name}`;

/// What enables or triggers a nested diagram stands in a member of its own, and not in "in".
export const isSwitch = (item: Item, port: number, body: any) =>
  item.type === 'diagram' && ['enable', 'trigger'].includes(item.in[port].name) && switchSignal(body?.[item.in[port].name]) === item.in[port].reads;

/// "enable": "signal", or {"in": "signal", ...}
const switchSignal = (value: any): string | undefined => (typeof value === 'string' ? value : value?.in);

/// An item with the ports alone that "in" wires.
export const withoutSwitches = (item: Item, body: any): Item => ({...item, in: item.in.filter((_, i) => !isSwitch(item, i, body))});

type In = string | string[] | Record<string, string | string[]> | undefined;

/// "in" with one more wire, or another one, at a port. Where several ports have names of their own they are written.
export function inWith(now: In, item: Item, port: number, signal: string): unknown {
  const reads = item.in.map((p, i) => (i === port ? signal : p.reads));
  return inOf(item.in.map((p) => p.name), reads, now);
}

/// "in" without the wire at a port.
export function inWithout(now: In, item: Item, port: number): unknown {
  return inOf(item.in.map((p) => p.name), item.in.map((p, i) => (i === port ? '' : p.reads)), now);
}

/// One more wire of a port that takes any number.
export function inAppended(now: In, item: Item, signal: string): unknown {
  const name = item.in[0]?.name ?? 'in';
  return inOf([...item.in.map((p) => p.name), name], [...item.in.map((p) => p.reads), signal], now);
}

function inOf(names: string[], reads: string[], now: In): unknown {
  const wired = names.map((name, i) => [name, reads[i]] as const).filter(([, from]) => from !== '');
  if (wired.length === 0) return undefined;
  const byName = now !== undefined && typeof now === 'object' && !Array.isArray(now);
  const isPrefix = reads.slice(0, wired.length).every((r) => r !== '');
  if (!byName && isPrefix) return wired.length === 1 ? wired[0][1] : wired.map(([, from]) => from);
  const object: Record<string, string | string[]> = {};
  for (const [name, from] of wired) {
    const before = object[name];
    object[name] = before === undefined ? from : [...(Array.isArray(before) ? before : [before]), from];
  }
  return object;
}

/// Sets, changes or removes a member of a block.
export function setMember(document: any, block: string, key: string, value: unknown): Edit[] {
  const has = document?.blocks?.[block] && key in document.blocks[block];
  if (value === undefined) return has ? [{kind: 'remove', pointer: pointer('blocks', block, key)}] : [];
  if (has) return [{kind: 'replace', pointer: pointer('blocks', block, key), value: jsonText(value)}];
  return [{kind: 'insert', pointer: pointer('blocks', block), key, value: jsonText(value)}];
}

/// A value of a block, or of the candidate in use where it is a choice, as it was typed; empty removes it, and the default
/// counts.
export function valueEdits(document: any, block: string, key: string, text: string): Edit[] {
  const node = document?.blocks?.[block];
  const value = text.trim() === '' ? undefined : typedValue(text);
  if (!(node?.from && node.choose)) return setMember(document, block, key, value);
  const at = pointer('blocks', block, 'from', node.choose);
  const has = key in (node.from[node.choose] ?? {});
  if (value === undefined) return has ? [{kind: 'remove', pointer: at + pointer(key)}] : [];
  if (has) return [{kind: 'replace', pointer: at + pointer(key), value: jsonText(value)}];
  return [{kind: 'insert', pointer: at, key, value: jsonText(value)}];
}

/// A member of "simulate", "parameters" ... as it was typed; empty removes it.
export function sectionEdits(document: any, section: string, key: string, text: string): Edit[] {
  const there = document?.[section]?.[key];
  if (text.trim() === '') return there !== undefined ? [{kind: 'remove', pointer: pointer(section, key)}] : [];
  const value = typedValue(text);
  if (section === 'parameters' && there && typeof there === 'object' && !Array.isArray(there) && 'value' in there) {
    const {unit: _unit, value: _value, ...others} = there;
    const parts = /^([-+.\deE]+)\s+(\S.*)$/.exec(String(value));
    const next = parts ? {value: Number(parts[1]), unit: parts[2], ...others} : {...there, value};
    return [{kind: 'replace', pointer: pointer(section, key), value: jsonText(next)}];
  }
  return [putInto(document, section, key, value)];
}

/// Makes a signal one that runs record, or one that they do not.
export function recordEdits(document: any, signal: string, on: boolean): Edit[] {
  const list: string[] | undefined = document?.record;
  const at = (list ?? []).indexOf(signal);
  if (on && at < 0)
    return list ? [{kind: 'insert', pointer: '/record', value: jsonText(signal)}]
                : [{kind: 'insert', pointer: '', key: 'record', value: jsonText([signal]), after: predecessor(document, 'record')}];
  return !on && at >= 0 ? [{kind: 'remove', pointer: pointer('record', at)}] : [];
}

/// The title of a diagram; empty removes it.
export function titleEdits(document: any, text: string): Edit[] {
  if (document && 'title' in document) return [text ? {kind: 'replace', pointer: '/title', value: jsonText(text)} : {kind: 'remove', pointer: '/title'}];
  return document && text ? [{kind: 'insert', pointer: '', key: 'title', value: jsonText(text), after: predecessor(document, 'title')}] : [];
}

/// Does a text that names a signal speak of this block? "stage", "stage.force", "stage/play", "stage[1]"
const speaksOf = (signal: unknown, block: string) =>
  typeof signal === 'string' && signal.startsWith(block) && /^($|[./[])/.test(signal.slice(block.length));

const renamedSignal = (signal: string, from: string, to: string) => (speaksOf(signal, from) ? to + signal.slice(from.length) : signal);

/// All places at which a document names signals, with the pointer of each.
function* signalPlaces(document: any): Generator<{at: string; signal: string}> {
  for (const [name, block] of Object.entries<any>(document?.blocks ?? {})) {
    const input = block?.in;
    const base = pointer('blocks', name, 'in');
    if (typeof input === 'string') yield {at: base, signal: input};
    else if (Array.isArray(input)) for (const [i, s] of input.entries()) yield {at: `${base}/${i}`, signal: s};
    else if (input)
      for (const [port, s] of Object.entries<any>(input)) {
        if (typeof s === 'string') yield {at: base + pointer(port), signal: s};
        else if (Array.isArray(s)) for (const [i, one] of s.entries()) yield {at: base + pointer(port, i), signal: one};
      }
  }
  for (const [name, block] of Object.entries<any>(document?.blocks ?? {}))
    for (const key of ['enable', 'trigger']) {
      const signal = block?.type === 'diagram' ? switchSignal(block[key]) : undefined;
      if (signal !== undefined) yield {at: pointer('blocks', name, key, ...(typeof block[key] === 'string' ? [] : ['in'])), signal};
    }
  for (const [name, s] of Object.entries<any>(document?.outputs ?? {})) yield {at: pointer('outputs', name), signal: s};
  for (const [i, s] of (document?.record ?? []).entries()) yield {at: pointer('record', i), signal: s};
}

/// A block by another name, and every wire that reads it.
export function renameBlock(document: any, from: string, to: string): Edit[] {
  const edits: Edit[] = [];
  for (const {at, signal} of signalPlaces(document))
    if (speaksOf(signal, from)) edits.push({kind: 'replace', pointer: at, value: jsonText(renamedSignal(signal, from, to))});
  edits.push({kind: 'rename', pointer: pointer('blocks', from), key: to});
  return edits;
}

/// Without these blocks: they, their names in "record" and the outputs that read them. Wires of others that read them
/// are taken out of "in".
export function removeBlocks(document: any, names: string[], items: Item[]): Edit[] {
  const edits: Edit[] = [];
  const gone = (signal: unknown) => names.some((n) => speaksOf(signal, n));
  for (const item of items) {
    const block = document?.blocks?.[item.name];
    if (!block || names.includes(item.name)) continue;
    const body = block.from?.[block.choose] ?? block;
    const ports = withoutSwitches(item, body).in;
    for (const key of ['enable', 'trigger']) if (item.type === 'diagram' && gone(switchSignal(block[key]))) edits.push({kind: 'remove', pointer: pointer('blocks', item.name, key)});
    if (!ports.some((p) => gone(p.reads))) continue;
    edits.push(...setMember(document, item.name, 'in', inOf(ports.map((p) => p.name), ports.map((p) => (gone(p.reads) ? '' : p.reads)), block.in)));
  }
  for (const [name, signal] of Object.entries(document?.outputs ?? {})) if (gone(signal)) edits.push({kind: 'remove', pointer: pointer('outputs', name)});
  const record: string[] = document?.record ?? [];
  for (let i = record.length - 1; i >= 0; --i) if (gone(record[i])) edits.push({kind: 'remove', pointer: pointer('record', i)});
  for (const name of names) {
    if (document?.blocks?.[name]) edits.push({kind: 'remove', pointer: pointer('blocks', name)});
    else if (document?.inputs?.[name]) edits.push({kind: 'remove', pointer: pointer('inputs', name)});
    else if (document?.outputs?.[name]) edits.push({kind: 'remove', pointer: pointer('outputs', name)});
  }
  return dedupe(edits);
}

const dedupe = (edits: Edit[]) => edits.filter((e, i) => edits.findIndex((o) => o.kind === e.kind && o.pointer === e.pointer) === i);

/// Blocks as JSON text for the clipboard.
export function copied(document: any, names: string[]): string {
  const blocks: Record<string, unknown> = {};
  for (const name of names) if (document?.blocks?.[name]) blocks[name] = document.blocks[name];
  return `{${Object.entries(blocks).map(([k, v]) => `\n  ${JSON.stringify(k)}: ${jsonText(v)}`).join(',')}\n}\n`;
}

/// Blocks from the clipboard under free names; wires among them follow, others stay as they are where such a signal is
/// there, and are left open where it is not.
export function pasted(document: any, text: string): {edits: Edit[]; names: string[]} | null {
  let blocks: any;
  try {
    blocks = JSON.parse(text);
  } catch {
    return null;
  }
  if (!blocks || typeof blocks !== 'object' || Array.isArray(blocks)) return null;
  if (!Object.values<any>(blocks).every((b) => b && typeof b === 'object' && ('type' in b || 'from' in b))) return null;
  const names = new Map<string, string>();
  const growing = {blocks: {...(document?.blocks ?? {})}, inputs: document?.inputs};
  for (const name of Object.keys(blocks)) {
    names.set(name, freeName(growing, name));
    growing.blocks[names.get(name)!] = {};
  }
  const follow = (signal: string) => {
    for (const [from, to] of names) if (speaksOf(signal, from)) return renamedSignal(signal, from, to);
    const head = signal.split(/[./[]/)[0];
    return document?.blocks?.[head] || document?.inputs?.[head] ? signal : '';
  };
  const followAll = (input: any): any => {
    if (typeof input === 'string') return follow(input) || undefined;
    if (Array.isArray(input)) {
      const list = input.map(follow);
      return list.every(Boolean) ? list : list.slice(0, list.indexOf('')).length ? list.slice(0, list.indexOf('')) : undefined;
    }
    if (!input) return undefined;
    const kept = Object.entries<any>(input).map(([p, s]) => [p, followAll(s)]).filter(([, s]) => s !== undefined);
    return kept.length ? Object.fromEntries(kept) : undefined;
  };
  const edits: Edit[] = [];
  let first = !document?.blocks;
  for (const [name, block] of Object.entries<any>(blocks)) {
    const value = {...block, in: followAll(block.in)};
    const to = names.get(name)!;
    edits.push(first ? putInto(document, 'blocks', to, value) : {kind: 'insert', pointer: '/blocks', key: to, value: jsonText(value)});
    first = false;
  }
  return {edits, names: [...names.values()]};
}

/// The edits that make one document the other, as few and as small as they come; names of files are left alone, since
/// they are relative to where a document lies.
export function changesBetween(before: any, after: any, at = ''): Edit[] {
  const isObject = (v: unknown): v is Record<string, unknown> => v !== null && typeof v === 'object' && !Array.isArray(v);
  if (!isObject(before) || !isObject(after)) {
    return jsonText(before) === jsonText(after) ? [] : [{kind: 'replace', pointer: at, value: jsonText(after)}];
  }
  const edits: Edit[] = [];
  for (const key of Object.keys(before)) if (!(key in after) && key !== '$schema') edits.push({kind: 'remove', pointer: at + pointer(key)});
  let previous = '';
  for (const [key, value] of Object.entries(after)) {
    const isFileName = key === '$schema' || ((key === 'file' || key === 'parameters') && typeof value === 'string');
    if (!(key in before)) edits.push({kind: 'insert', pointer: at, key, value: jsonText(value), after: previous});
    else if (!isFileName) edits.push(...changesBetween(before[key], value, at + pointer(key)));
    previous = key;
  }
  return edits;
}
