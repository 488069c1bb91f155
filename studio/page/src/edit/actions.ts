// Decides what the gestures of canvas and panels do: they become edits (document.ts) of the open file.

import {movesOf} from '../canvas/moving';
import {api} from '../data/api';
import {currentPath, useStudio} from '../data/store';
import type {Edit, Item, JobOrder} from '../types';
import * as doc from './document';
import {runOrder} from './orders';

const now = () => useStudio.getState();

export const signalOf = doc.signalName;

function declarationOf(type: string) {
  return now().catalogue?.blocks.find((b) => b.type === type);
}

/// The body in which a block's own values stand: for a choice those of the candidate in use.
export function bodyOf(block: any): any {
  return block?.from && block.choose ? block.from[block.choose] : block;
}

export async function connect(from: Item, out: number, to: Item, port: number): Promise<void> {
  const {document, edit} = now();
  const signal = doc.signalName(from, out);
  if (to.type === 'output') {
    await edit([{kind: 'replace', pointer: doc.pointer('outputs', to.name), value: doc.jsonText(signal)}]);
    return;
  }
  const block = document?.blocks?.[to.name];
  if (!block) return;
  const body = bodyOf(block);
  if (doc.isSwitch(to, port, body)) {
    const key = to.in[port].name;
    await setValue(to.name, key, typeof body[key] === 'string' ? signal : doc.jsonText({...body[key], in: signal}));
    return;
  }
  to = doc.withoutSwitches(to, body);
  const takesAny = declarationOf(to.type)?.inputs.find((p) => p.name === to.in[port]?.name)?.any_number;
  const into = takesAny && to.in[port].reads ? doc.inAppended(block.in, to, signal) : doc.inWith(block.in, to, port, signal);
  await edit(doc.setMember(document, to.name, 'in', into));
}

let choices = 0;  // a list that is typed into tells a choice per letter: the last of them counts

/// The same by names, as a list or the keyboard give them; refused, in the words of check, where the units do not fit.
export async function connectSignal(signal: string, to: Item, port: number): Promise<void> {
  const {view, say, tell} = now();
  const items = view?.sheet?.items ?? [];
  const from = items.find((i) => i.out.some((_, k) => doc.signalName(i, k) === signal));
  if (!from) return;
  const choice = ++choices;
  try {
    const fits = await api.fits(currentPath(now()), signal);
    if (choice !== choices) return;
    const why = fits.find((f) => f.item === items.findIndex((i) => i.path === to.path) && f.in === port)?.why;
    if (why) say(why, 'error');
    else await connect(from, from.out.findIndex((_, k) => doc.signalName(from, k) === signal), to, port);
  } catch (error) {
    tell(error);
  }
}

export async function disconnect(to: Item, port: number): Promise<void> {
  const {document, edit} = now();
  if (to.type === 'output') await edit([{kind: 'remove', pointer: doc.pointer('outputs', to.name)}]);
  else {
    const block = document?.blocks?.[to.name];
    if (doc.isSwitch(to, port, bodyOf(block))) await setValue(to.name, to.in[port].name, '');
    else await edit(doc.setMember(document, to.name, 'in', doc.inWithout(block?.in, doc.withoutSwitches(to, bodyOf(block)), port)));
  }
}

/// A new block; wired to the selected one, where that is wanted and the type has an input. It stands where it was dropped
/// (with its middle there), else where the layout puts it.
export async function place(type: string, wired = true, at?: {x: number; y: number}): Promise<void> {
  const {document, edit, selected, view} = now();
  const declaration = declarationOf(type);
  if (!document || !declaration) return;
  const name = doc.freeName(document, type);
  const block = doc.newBlock(declaration);
  const from = view?.sheet?.items.find((i) => i.path === selected[0] && i.out.length > 0);
  if (from && wired && declaration.inputs.length) block.in = doc.signalName(from, 0);
  if (!(await edit([doc.putInto(document, 'blocks', name, block)]))) return;
  now().set({selected: [name], selectedWire: ''});
  const item = now().view?.sheet?.items.find((i) => i.path === name);
  if (at && item) await now().move(movesOf({[name]: {x: at.x - item.width / 2, y: at.y - item.height / 2}}));
}

export async function removeSelected(): Promise<void> {
  const {document, edit, selected, selectedWire, view} = now();
  if (selectedWire && view?.sheet) {
    const wire = view.sheet.wires.find((w) => `${w.signal}>${view.sheet!.items[w.to].path}/${w.in}` === selectedWire);
    if (wire) await disconnect(view.sheet.items[wire.to], wire.in);
    now().set({selectedWire: ''});
    return;
  }
  if (!selected.length || !view?.sheet) return;
  if (await edit(doc.removeBlocks(document, selected, view.sheet.items))) now().set({selected: []});
}

export async function rename(from: string, to: string): Promise<void> {
  const {document, edit} = now();
  if (from === to || !to) return;
  if (await edit(doc.renameBlock(document, from, to))) now().set({selected: [to]});
}

/// A value as it was typed; empty removes it, and the default counts.
export async function setValue(block: string, key: string, text: string): Promise<void> {
  const {document, edit} = now();
  const node = document?.blocks?.[block];
  const isChoice = node?.from && node.choose;
  const value = text.trim() === '' ? undefined : doc.typedValue(text);
  if (!isChoice) {
    await edit(doc.setMember(document, block, key, value));
    return;
  }
  const at = doc.pointer('blocks', block, 'from', node.choose);
  const has = key in (node.from[node.choose] ?? {});
  if (value === undefined) await edit(has ? [{kind: 'remove', pointer: at + doc.pointer(key)}] : []);
  else if (has) await edit([{kind: 'replace', pointer: at + doc.pointer(key), value: doc.jsonText(value)}]);
  else await edit([{kind: 'insert', pointer: at, key, value: doc.jsonText(value)}]);
}

export async function choose(block: string, candidate: string): Promise<void> {
  await now().edit([{kind: 'replace', pointer: doc.pointer('blocks', block, 'choose'), value: doc.jsonText(candidate)}]);
}

/// A member of "simulate", "parameters" ... as it was typed.
export async function setIn(section: string, key: string, text: string): Promise<void> {
  const {document, edit} = now();
  const there = document?.[section]?.[key];
  if (text.trim() === '') {
    if (there !== undefined) await edit([{kind: 'remove', pointer: doc.pointer(section, key)}]);
    return;
  }
  const value = doc.typedValue(text);
  if (section === 'parameters' && there && typeof there === 'object' && !Array.isArray(there) && 'value' in there) {
    const {unit: _unit, ...others} = there;
    const parts = /^([-+.\deE]+)\s+(\S.*)$/.exec(String(value));
    const next = parts ? {value: Number(parts[1]), unit: parts[2], ...withoutValue(others)} : {...there, value};
    await edit([{kind: 'replace', pointer: doc.pointer(section, key), value: doc.jsonText(next)}]);
    return;
  }
  await edit([doc.putInto(document, section, key, value)]);
}

function withoutValue(members: any): any {
  const {value: _value, ...others} = members;
  return others;
}

/// Is a signal recorded by runs? Switches it.
export async function record(signal: string, on: boolean): Promise<void> {
  const {document, edit} = now();
  const list: string[] = document?.record ?? [];
  const at = list.indexOf(signal);
  const edits: Edit[] = [];
  if (on && at < 0)
    edits.push(document?.record ? {kind: 'insert', pointer: '/record', value: doc.jsonText(signal)}
                                : {kind: 'insert', pointer: '', key: 'record', value: doc.jsonText([signal]), after: doc.predecessor(document, 'record')});
  if (!on && at >= 0) edits.push({kind: 'remove', pointer: doc.pointer('record', at)});
  await edit(edits);
}

export async function openNested(item: Item): Promise<void> {
  const {document, open} = now();
  const file = bodyOf(document?.blocks?.[item.name])?.file;
  if (!file) return;
  const folder = currentPath(now()).split('/').slice(0, -1);
  for (const part of String(file).split('/')) {
    if (part === '..') folder.pop();
    else if (part !== '.') folder.push(part);
  }
  await open(folder.join('/'), true, item.name);
}

export async function copy(): Promise<void> {
  const {document, selected} = now();
  if (selected.length) await navigator.clipboard.writeText(doc.copied(document, selected));
}

export async function paste(text: string): Promise<void> {
  const {document, edit, say} = now();
  const found = doc.pasted(document, text);
  if (!found) {
    say('the clipboard holds no blocks: copy them here, or write {"name": {"type": ...}}', 'error');
    return;
  }
  if (await edit(found.edits)) now().set({selected: found.names});
}

/// The diagram that discover wrote, beside the open one: shown, not written.
export async function tryStep(job: string, file: string, title: string): Promise<void> {
  const {set, tell, jobs, document} = now();
  const folder = jobs.find((j) => j.id === job)?.folder;
  if (!folder) return;
  try {
    const view = await api.view(`${folder}/${file}`, 0);
    const other = JSON.parse(view.text);
    const fresh = Object.keys(other.blocks ?? {}).filter((name) => doc.changesBetween(document?.blocks?.[name], other.blocks[name]).length > 0);
    set({trial: {job, file, view, title, fresh, edits: doc.changesBetween(document, other)}, selected: [], selectedWire: ''});
  } catch (error) {
    tell(error);
  }
}

export async function accept(): Promise<void> {
  const {trial, edit, set} = now();
  if (!trial) return;
  const edits = trial.edits;
  set({trial: null});
  await edit(edits);
}

export async function setTitle(text: string): Promise<void> {
  const {document, edit} = now();
  if (!document) return;
  if ('title' in document) await edit([text ? {kind: 'replace', pointer: '/title', value: doc.jsonText(text)} : {kind: 'remove', pointer: '/title'}]);
  else if (text) await edit([{kind: 'insert', pointer: '', key: 'title', value: doc.jsonText(text), after: doc.predecessor(document, 'title')}]);
}

/// The unit of an input of the diagram.
export async function setInput(name: string, unit: string): Promise<void> {
  const {document, edit} = now();
  await edit([{kind: 'replace', pointer: doc.pointer('inputs', name), value: doc.jsonText({...document.inputs[name], unit})}]);
}

/// Runs, of which the last is looked at and the others lie behind it.
export async function compareRuns(orders: JobOrder[]): Promise<void> {
  const {tell, poll, set} = now();
  try {
    const ids: string[] = [];
    for (const order of orders) ids.push(await api.begin(order));
    set({shownJob: ids[ids.length - 1], pinnedJobs: ids.slice(0, -1), tab: 'scopes'});
    await poll();
  } catch (error) {
    tell(error);
  }
}

/// Each candidate of a choice, run and laid over the others; the one in use is the one that is looked at.
export async function compareCandidates(block: string): Promise<void> {
  const {document, data} = now();
  const node = document?.blocks?.[block];
  if (!node?.from) return;
  const order = runOrder(currentPath(now()), data, document);
  const others = Object.keys(node.from).filter((name) => name !== node.choose);
  await compareRuns([...others, node.choose].map((name) => ({...order, options: {...order.options, '--choose': [`${block}=${name}`]}})));
}
