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

/// The item as it is shown now.
const itemNow = (item: Item): Item => now().view?.sheet?.items.find((i) => i.path === item.path) ?? item;

export const connect = (from: Item, out: number, to: Item, port: number): Promise<boolean> =>
  now().edit(() => connectEdits(doc.signalName(from, out), itemNow(to), port));

function connectEdits(signal: string, to: Item, port: number): Edit[] {
  const {document} = now();
  if (to.type === 'output') return [{kind: 'replace', pointer: doc.pointer('outputs', to.name), value: doc.jsonText(signal)}];
  const block = document?.blocks?.[to.name];
  if (!block) return [];
  const body = bodyOf(block);
  if (doc.isSwitch(to, port, body)) {
    const key = to.in[port].name;
    return doc.valueEdits(document, to.name, key, typeof body[key] === 'string' ? signal : doc.jsonText({...body[key], in: signal}));
  }
  const wired = doc.withoutSwitches(to, body);
  const takesAny = declarationOf(wired.type)?.inputs.find((p) => p.name === wired.in[port]?.name)?.any_number;
  const into = takesAny && wired.in[port].reads ? doc.inAppended(block.in, wired, signal) : doc.inWith(block.in, wired, port, signal);
  return doc.setMember(document, to.name, 'in', into);
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
    else await now().edit(() => (choice === choices ? connectEdits(signal, itemNow(to), port) : []));
  } catch (error) {
    tell(error);
  }
}

export const disconnect = (to: Item, port: number): Promise<boolean> => now().edit(() => disconnectEdits(itemNow(to), port));

function disconnectEdits(to: Item, port: number): Edit[] {
  const {document} = now();
  if (to.type === 'output') return [{kind: 'remove', pointer: doc.pointer('outputs', to.name)}];
  const block = document?.blocks?.[to.name];
  const body = bodyOf(block);
  if (doc.isSwitch(to, port, body)) return doc.valueEdits(document, to.name, to.in[port].name, '');
  return doc.setMember(document, to.name, 'in', doc.inWithout(block?.in, doc.withoutSwitches(to, body), port));
}

/// A new block; wired to the selected one, where that is wanted and the type has an input. It stands where it was dropped
/// (with its middle there), else where the layout puts it.
export async function place(type: string, wired = true, at?: {x: number; y: number}): Promise<void> {
  const {edit, selected} = now();
  const declaration = declarationOf(type);
  if (!now().document || !declaration) return;
  let name = '';
  const done = await edit(() => {
    const {document, view} = now();
    name = doc.freeName(document, type);
    const block = doc.newBlock(declaration);
    const from = view?.sheet?.items.find((i) => i.path === selected[0] && i.out.length > 0);
    if (from && wired && declaration.inputs.length) block.in = doc.signalName(from, 0);
    return [doc.putInto(document, 'blocks', name, block)];
  });
  if (!done) return;
  now().set({selected: [name], selectedWire: ''});
  const item = now().view?.sheet?.items.find((i) => i.path === name);
  if (at && item) await now().move(movesOf({[name]: {x: at.x - item.width / 2, y: at.y - item.height / 2}}));
}

export async function removeSelected(): Promise<void> {
  const {edit, selected, selectedWire, view} = now();
  if (selectedWire && view?.sheet) {
    const wire = view.sheet.wires.find((w) => `${w.signal}>${view.sheet!.items[w.to].path}/${w.in}` === selectedWire);
    if (wire) await disconnect(view.sheet.items[wire.to], wire.in);
    now().set({selectedWire: ''});
    return;
  }
  if (!selected.length || !view?.sheet) return;
  if (await edit(() => doc.removeBlocks(now().document, selected, now().view?.sheet?.items ?? []))) now().set({selected: []});
}

export async function rename(from: string, to: string): Promise<void> {
  if (from === to || !to) return;
  if (await now().edit(() => doc.renameBlock(now().document, from, to))) now().set({selected: [to]});
}

/// A value as it was typed; empty removes it, and the default counts.
export async function setValue(block: string, key: string, text: string): Promise<void> {
  await now().edit(() => doc.valueEdits(now().document, block, key, text));
}

export async function choose(block: string, candidate: string): Promise<void> {
  await now().edit([{kind: 'replace', pointer: doc.pointer('blocks', block, 'choose'), value: doc.jsonText(candidate)}]);
}

/// A member of "simulate", "parameters" ... as it was typed.
export async function setIn(section: string, key: string, text: string): Promise<void> {
  await now().edit(() => doc.sectionEdits(now().document, section, key, text));
}

/// Is a signal recorded by runs? Switches it.
export async function record(signal: string, on: boolean): Promise<void> {
  await now().edit(() => doc.recordEdits(now().document, signal, on));
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
  const {edit, say} = now();
  let names: string[] | undefined;
  const done = await edit(() => {
    const found = doc.pasted(now().document, text);
    names = found?.names;
    return found?.edits ?? [];
  });
  if (!names) say('the clipboard holds no blocks: copy them here, or write {"name": {"type": ...}}', 'error');
  else if (done) now().set({selected: names});
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
  await now().edit(() => doc.titleEdits(now().document, text));
}

/// The unit of an input of the diagram.
export async function setInput(name: string, unit: string): Promise<void> {
  await now().edit(() => [{kind: 'replace', pointer: doc.pointer('inputs', name), value: doc.jsonText({...now().document.inputs[name], unit})}]);
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
