// Decides how blocks are moved by hand: on a grid, with wires that follow simply until the server has led them around the
// blocks. Plain functions.

import type {Moves, Point} from '../types';

export const grid = 4;  // [px], as draw/moved.h has it

const lead = 14;  // straight before an input and behind an output

/// Steps of the grid for places in pixels.
export function movesOf(places: Record<string, {x: number; y: number}>): Moves {
  return Object.fromEntries(Object.entries(places).map(([name, p]) => [name, [Math.round(p.x / grid), Math.round(p.y / grid)] as Point]));
}

/// From an output to an input on the left of a block, while one of them is on its way.
export function looseWire([x1, y1]: Point, [x2, y2]: Point): Point[] {
  if (x2 - x1 >= 2 * lead) {
    const middle = Math.round((x1 + x2) / 2);
    return y1 === y2 ? [[x1, y1], [x2, y2]] : [[x1, y1], [middle, y1], [middle, y2], [x2, y2]];
  }
  const between = Math.round((y1 + y2) / 2);
  return [[x1, y1], [x1 + lead, y1], [x1 + lead, between], [x2 - lead, between], [x2 - lead, y2], [x2, y2]];
}
