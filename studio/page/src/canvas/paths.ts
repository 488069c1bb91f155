// Decides how the way of a wire becomes a path: horizontal and vertical pieces with rounded corners, an arrow head.

import type {Point} from '../types';

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
