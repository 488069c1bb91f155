// Decides how much room a sheet takes with everything that is written beside its blocks: what is to be seen when all of it
// is looked at. Plain functions.

import type {Item, Sheet} from '../types';

const letter = 6.4;  // [px] of a name, on the average
const line = 12;     // [px] from one line of a caption to the next

export const sumNameOffset = 20;  // [px] from the middle of a sum to its name, as draw/sheet.h has it

/// Which candidate is chosen, as it stands below a block that has several.
export function choiceText(item: Item): string {
  return item.choice && item.choice.candidates > 1 ? `${item.choice.chosen} (1 of ${item.choice.candidates})` : '';
}

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

function extentOf(item: Item): [number, number, number, number] {
  if (item.inside || item.symbol.outline === 'port') return [item.x, item.y, item.x + item.width, item.y + item.height];
  const middle = item.x + item.width / 2;
  const lines = [...item.caption, choiceText(item)].filter(Boolean);
  const half = (letter / 2) * Math.max(0, ...lines.map((t) => t.length));
  const name = letter * item.name.length;
  const [left, right] = item.symbol.outline === 'circle' ? [0, sumNameOffset + name] : [name / 2, name / 2];
  return [Math.min(item.x, middle - half, middle - left), item.y - 8, Math.max(item.x + item.width, middle + half, middle + right), item.y + item.height + 18 + line * lines.length];
}

/// The blocks with their names and captions, and the wires.
export function extent(sheet: Sheet): Box {
  const boxes = sheet.items.map(extentOf);
  const points = sheet.wires.flatMap((w) => w.path);
  const xs = [...boxes.flatMap((b) => [b[0], b[2]]), ...points.map((p) => p[0])];
  const ys = [...boxes.flatMap((b) => [b[1], b[3]]), ...points.map((p) => p[1])];
  if (xs.length === 0) return {x: 0, y: 0, width: sheet.width, height: sheet.height};
  const least = (values: number[]) => values.reduce((a, b) => Math.min(a, b));
  const most = (values: number[]) => values.reduce((a, b) => Math.max(a, b));
  const [x, y] = [least(xs), least(ys)];
  return {x, y, width: most(xs) - x, height: most(ys) - y};
}
