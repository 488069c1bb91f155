// Decides which blocks a few letters find, best first.

import type {BlockDeclaration} from '../types';
import {simulinkNames} from './simulink';

function score(block: BlockDeclaration, word: string): number {
  const type = block.type.toLowerCase();
  if (type === word) return 100;
  if (type.startsWith(word)) return 60;
  if (type.split('_').some((part) => part.startsWith(word))) return 40;
  const other = (simulinkNames[block.type] ?? []).map((n) => n.toLowerCase());
  if (other.some((n) => n.startsWith(word))) return 35;
  if (other.some((n) => n.includes(word))) return 25;
  if (type.includes(word)) return 20;
  if (block.summary.toLowerCase().includes(word)) return 8;
  return 0;
}

/// All that match every word; without words all, in their order.
export function found(blocks: BlockDeclaration[], words: string): BlockDeclaration[] {
  const list = words.toLowerCase().split(/\s+/).filter(Boolean);
  const shown = blocks.filter((b) => b.group !== 'internal');
  if (list.length === 0) return shown;
  return shown
    .map((block) => ({block, scores: list.map((w) => score(block, w))}))
    .filter(({scores}) => scores.every((s) => s > 0))
    .map(({block, scores}) => ({block, sum: scores.reduce((a, b) => a + b, 0)}))
    .sort((a, b) => b.sum - a.sum)
    .map(({block}) => block);
}
