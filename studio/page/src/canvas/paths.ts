// Decides how the way of a wire becomes a path: horizontal and vertical pieces with rounded corners, an arrow head.

import type {Point, Wire} from '../types';

const radius = 5;

/// An SVG path through the points, corners rounded as far as the pieces are long enough.
export function roundedPath(points: Point[]): string {
  if (points.length === 0) return '';
  let d = `M${points[0][0]} ${points[0][1]}`;
  for (let i = 1; i < points.length - 1; ++i) {
    const [a, b, c] = [points[i - 1], points[i], points[i + 1]];
    const before = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const behind = Math.hypot(c[0] - b[0], c[1] - b[1]);
    const r = Math.min(radius, before / 2, behind / 2);
    if (r < 0.5) {
      d += `L${b[0]} ${b[1]}`;
      continue;
    }
    const from = [b[0] - ((b[0] - a[0]) / before) * r, b[1] - ((b[1] - a[1]) / before) * r];
    const to = [b[0] + ((c[0] - b[0]) / behind) * r, b[1] + ((c[1] - b[1]) / behind) * r];
    d += `L${from[0]} ${from[1]}Q${b[0]} ${b[1]} ${to[0]} ${to[1]}`;
  }
  const last = points[points.length - 1];
  return `${d}L${last[0]} ${last[1]}`;
}

/// The corners of an arrow head with its tip at `tip`, coming from `from`.
export function arrowHead(from: Point, tip: Point, length: number): string {
  const distance = Math.hypot(tip[0] - from[0], tip[1] - from[1]) || 1;
  const [ax, ay] = [(tip[0] - from[0]) / distance, (tip[1] - from[1]) / distance];
  const foot = [tip[0] - length * ax, tip[1] - length * ay];
  const half = 0.4 * length;
  return [tip, [foot[0] - half * ay, foot[1] + half * ax], [foot[0] + half * ay, foot[1] - half * ax]]
    .map((p) => p.map((v) => v.toFixed(1)).join(','))
    .join(' ');
}

/// Where `path` leaves the way of `other`, which begins at the same point: the index of its next corner, and the point.
function leaving(path: Point[], other: Point[]): {next: number; at: Point} {
  let at = path[0];
  for (let i = 1; i < Math.min(path.length, other.length); ++i) {
    const [a, b] = [path[i], other[i]];
    if (a[0] === b[0] && a[1] === b[1]) {
      at = a;
      continue;
    }
    const along = (p: Point): [number, number] => [Math.sign(p[0] - at[0]), Math.sign(p[1] - at[1])];
    const [da, db] = [along(a), along(b)];
    if (da[0] !== db[0] || da[1] !== db[1]) return {next: i, at};
    const length = (p: Point) => Math.abs(p[0] - at[0]) + Math.abs(p[1] - at[1]);
    return length(b) < length(a) ? {next: i, at: b} : {next: i + 1, at: a};
  }
  return {next: Math.min(path.length, other.length), at};
}

const reach = (path: Point[], {next, at}: {next: number; at: Point}) => {
  let length = 0;
  for (let i = 1; i < next && i < path.length; ++i) length += Math.abs(path[i][0] - path[i - 1][0]) + Math.abs(path[i][1] - path[i - 1][1]);
  const last = path[Math.min(next, path.length) - 1];
  return length + Math.abs(at[0] - last[0]) + Math.abs(at[1] - last[1]);
};

/// What each wire draws: wires of one output share their way as far as they go together, and lines that lie on one
/// another look thicker than they are. The first draws all of it, the others from where they leave.
export function ownWays(wires: Wire[]): Point[][] {
  const before = new Map<string, Point[][]>();
  return wires.map((wire) => {
    const key = `${wire.from}/${wire.out}`;
    const others = before.get(key) ?? [];
    before.set(key, [...others, wire.path]);
    let best = {next: 1, at: wire.path[0]};
    for (const other of others) {
      const found = leaving(wire.path, other);
      if (reach(wire.path, found) > reach(wire.path, best)) best = found;
    }
    const rest = wire.path.slice(best.next);
    return rest.length ? [best.at, ...rest] : wire.path;
  });
}
