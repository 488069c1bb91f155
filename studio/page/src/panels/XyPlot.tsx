// Decides how curves are drawn that do not run over time: loops of one signal over another, spectra. SVG; the axes are
// straight or logarithmic.

import {useState, type PointerEvent} from 'react';
import {short, withUnit} from '../numbers';
import {useWidth} from './size';
import {powerTicks, roundTicks} from './ticks';

export interface XyCurve {
  label: string;
  color: string;  // the name of a colour: "--curve-1"
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  dash?: number[];
}

interface Axis {
  name: string;
  unit: string;
  logarithmic?: boolean;
}

const margin = {left: 76, right: 16, top: 8, bottom: 40};

function reachOf(curves: XyCurve[], key: 'x' | 'y', logarithmic = false): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const c of curves)
    for (let i = 0; i < c[key].length; ++i) {
      const v = c[key][i];
      if (!Number.isFinite(v) || (logarithmic && v <= 0)) continue;
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
  if (!(low <= high)) return logarithmic ? [0.1, 1] : [0, 1];
  if (logarithmic) return low === high ? [low / 2, 2 * high] : [Math.max(low, 1e-9 * high), high];  // nothing is seen nine decades below
  const room = low === high ? Math.abs(low) || 1 : 0.04 * (high - low);
  return [low - room, high + room];
}

export function XyPlot({curves, x, y, height, note}: {curves: XyCurve[]; x: Axis; y: Axis; height: number; note?: string}) {
  const [width, holder] = useWidth(600);
  const [near, setNear] = useState<{x: number; y: number; px: number; py: number; color: string} | null>(null);
  const [x0, x1] = reachOf(curves, 'x', x.logarithmic);
  const [y0, y1] = reachOf(curves, 'y', y.logarithmic);
  const [w, h] = [Math.max(40, width - margin.left - margin.right), Math.max(40, height - margin.top - margin.bottom)];
  const share = (v: number, a: number, b: number, log?: boolean) => (log ? Math.log(Math.max(v, a) / a) / Math.log(b / a) : (v - a) / (b - a));
  const atX = (v: number) => margin.left + w * share(v, x0, x1, x.logarithmic);
  const atY = (v: number) => margin.top + h * (1 - share(v, y0, y1, y.logarithmic));
  const ticks = (a: number, b: number, log: boolean | undefined, room: number, each: number) => (log ? powerTicks : roundTicks)(a, b, Math.max(2, Math.floor(room / each))).filter((v) => v >= a && v <= b);
  const pathOf = (c: XyCurve) => {
    let d = '';
    for (let i = 0; i < c.x.length; ++i) d += `${i ? 'L' : 'M'}${atX(c.x[i]).toFixed(1)} ${atY(c.y[i]).toFixed(1)}`;
    return d;
  };
  const move = (e: PointerEvent<SVGSVGElement>) => {
    const box = e.currentTarget.getBoundingClientRect();
    const [mx, my] = [e.clientX - box.left, e.clientY - box.top];
    let best = Infinity;
    let found: typeof near = null;
    for (const c of curves)
      for (let i = 0; i < c.x.length; ++i) {
        const [px, py] = [atX(c.x[i]), atY(c.y[i])];
        const distance = x.logarithmic ? Math.abs(px - mx) + 0.02 * Math.abs(py - my) : Math.hypot(px - mx, py - my);
        if (distance < best) [best, found] = [distance, {x: c.x[i], y: c.y[i], px, py, color: c.color}];
      }
    setNear(found);
  };
  return (
    <div className="xy" ref={holder}>
      <svg width={width} height={height} role="img" aria-label={`${y.name} over ${x.name}`} onPointerMove={move} onPointerLeave={() => setNear(null)}>
        {ticks(x0, x1, x.logarithmic, w, 70).map((v) => (
          <g key={`x${v}`}><line className="grid-line" x1={atX(v)} x2={atX(v)} y1={margin.top} y2={margin.top + h} /><text x={atX(v)} y={margin.top + h + 16} textAnchor="middle">{short(v, 6)}</text></g>
        ))}
        {ticks(y0, y1, y.logarithmic, h, 36).map((v) => (
          <g key={`y${v}`}><line className="grid-line" x1={margin.left} x2={margin.left + w} y1={atY(v)} y2={atY(v)} /><text x={margin.left - 8} y={atY(v) + 4} textAnchor="end">{short(v, 5)}</text></g>
        ))}
        <text x={margin.left + w / 2} y={height - 6} textAnchor="middle">{x.name}{x.unit && ` [${x.unit}]`}</text>
        <text transform={`translate(14,${margin.top + h / 2}) rotate(-90)`} textAnchor="middle">{y.name}{y.unit && ` [${y.unit}]`}</text>
        {curves.map((c) => <path key={c.label} d={pathOf(c)} fill="none" stroke={`var(${c.color})`} strokeWidth={1.5} strokeDasharray={c.dash?.join(' ')}><title>{c.label}</title></path>)}
        {near && <circle cx={near.px} cy={near.py} r={3.5} fill={`var(${near.color})`} />}
      </svg>
      <p className="hint">{near ? `${withUnit(near.x, x.unit, 5)}, ${withUnit(near.y, y.unit, 5)}` : note ?? ' '}</p>
    </div>
  );
}
