// Decides what is offered while the text of a diagram is typed: keys and words from the declarations of the blocks, and
// the signals of the diagram. Plain functions; the editor (panels/CodeEditor.ts) shows it.

import type {BlockDeclaration} from '../types';

export interface Offer {
  label: string;
  detail: string;
  apply: string;
}

const topLevel: Record<string, string> = {
  format: '1', title: '""', source: '""', remark: '""', parameters: '{}', inputs: '{}', blocks: '{}', outputs: '{}', record: '[]', simulate: '{"until": "1 s", "every": "1 ms"}',
};
const everyBlock: Record<string, string> = {type: 'which block it is', in: 'the signals that it reads'};

const offer = (label: string, detail: string, apply: string): Offer => ({label, detail, apply});

/// Where the cursor stands: the keys that lead there, whether a key or a value is typed, the members that are there.
export interface Place {
  path: string[];
  isKey: boolean;
  members: Record<string, unknown>;
}

/// Signals that can be read: blocks, inputs, and outputs of blocks that have several.
export function signalsOf(document: any, blocks: BlockDeclaration[]): string[] {
  const names = Object.keys(document?.inputs ?? {});
  for (const [name, block] of Object.entries<any>(document?.blocks ?? {})) {
    const body = block?.from ? block.from[block.choose] : block;
    const outputs = blocks.find((b) => b.type === body?.type)?.outputs ?? [];
    if (outputs.length > 1) names.push(...outputs.map((o) => `${name}.${o.name}`));
    else names.push(name);
  }
  return names;
}

export function offersAt(place: Place, document: any, blocks: BlockDeclaration[]): Offer[] {
  const {path, isKey, members} = place;
  const inBlock = path[0] === 'blocks' && (path.length === 2 || (path.length === 4 && path[2] === 'from'));
  if (isKey) {
    const there = new Set(Object.keys(members));
    const free = (offers: Offer[]) => offers.filter((o) => !there.has(o.label));
    if (path.length === 0) return free(Object.entries(topLevel).map(([key, value]) => offer(key, '', `"${key}": ${value}`)));
    if (!inBlock) return [];
    const declared = blocks.find((b) => b.type === members.type);
    return free([
      ...Object.entries(everyBlock).map(([key, meaning]) => offer(key, meaning, `"${key}": ""`)),
      ...(declared?.parameters ?? []).map((p) => offer(p.name, `${p.unit ? `[${p.unit}] ` : ''}${p.meaning}`, `"${p.name}": ${p.kind === 'list' ? '[]' : p.default && p.kind === 'number' ? JSON.stringify(p.default) : '""'}`)),
    ]);
  }
  const key = path[path.length - 1];
  const owner = path.slice(0, -1);
  const ofBlock = owner[0] === 'blocks' && (owner.length === 2 || (owner.length === 4 && owner[2] === 'from'));
  const words = (list: string[], detail: (word: string) => string) => list.map((word) => offer(word, detail(word), JSON.stringify(word)));
  if (ofBlock && key === 'type') return words(blocks.map((b) => b.type), (type) => blocks.find((b) => b.type === type)?.summary ?? '');
  if (ofBlock && key === 'choose') return words(Object.keys((members.from as object) ?? {}), () => 'candidate');
  const readsSignal = (ofBlock && key === 'in') || path.includes('in') || owner[0] === 'outputs' || path[0] === 'record';
  if (readsSignal) return words(signalsOf(document, blocks), () => 'signal');
  if (ofBlock) return words(blocks.find((b) => b.type === members.type)?.parameters.find((p) => p.name === key)?.choices ?? [], () => '');
  return [];
}
