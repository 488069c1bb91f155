// Decides how curves are drawn: uPlot with what the server gives, smallest and largest value per pixel, so that nothing
// gets lost however many rows there are. Zooming asks the server anew.

import {useEffect, useRef} from 'react';
import uPlot from 'uplot';
import type {Point} from '../types';
import {zigzag} from './zigzag';

export interface Curve {
  label: string;
  color: string;
  dash?: number[];
  x: Float64Array;
  low: Float64Array;
  high: Float64Array;
}

interface Props {
  curves: Curve[];
  unit: string;
  spans?: Point[];
  bands?: {x: Float64Array; low: Float64Array; high: Float64Array}[];  // what a tolerance allows
  range: Point | null;          // what is shown; null: all of it
  onZoom: (range: Point | null) => void;
  onPixels?: (pixels: number) => void;
  marks?: (number | undefined)[];  // cursors that stand
  onMark?: (at: number) => void;   // a click
  onCursor?: (at: number | null, values: Record<string, number>) => void;  // of the curves, by their labels
  sync: string;
  height: number;
  hasTimes: boolean;            // the lowest of several: the others share its times
}

function dataOf(curves: Curve[]): uPlot.AlignedData {
  const tables = curves.map((c) => zigzag(c.x, c.low, c.high) as unknown as uPlot.AlignedData);
  if (tables.length === 0) return [[]] as unknown as uPlot.AlignedData;
  const sameX = tables.every((t) => t[0].length === tables[0][0].length && t[0].every((v, i) => v === tables[0][0][i]));
  if (sameX) return [tables[0][0], ...tables.map((t) => t[1])] as uPlot.AlignedData;
  // Stretches of different lengths: one row per time of any of them.
  const all = [...new Set(tables.flatMap((t) => t[0] as number[]))].sort((a, b) => a - b);
  const rows = tables.map((t) => {
    const at = new Map<number, number>();
    (t[0] as number[]).forEach((x, i) => at.set(x, (t[1] as number[])[i]));
    return all.map((x) => at.get(x) ?? undefined);
  });
  return [all, ...rows] as unknown as uPlot.AlignedData;
}

const colour = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/// The area between low and high.
function fillBand(u: uPlot, band: {x: Float64Array; low: Float64Array; high: Float64Array}, fill: string): void {
  const {left, top, width, height} = u.bbox;
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
  u.ctx.beginPath();
  const corner = (i: number, y: number) => u.ctx.lineTo(u.valToPos(band.x[i], 'x', true), u.valToPos(y, 'y', true));
  for (let i = 0; i < band.x.length; ++i) corner(i, band.high[i]);
  for (let i = band.x.length; i-- > 0;) corner(i, band.low[i]);
  u.ctx.closePath();
  u.ctx.fillStyle = fill;
  u.ctx.fill();
  u.ctx.restore();
}

/// A cursor that stands: a line with its letter.
function drawMark(u: uPlot, at: number, letter: string, ink: string): void {
  const x = Math.round(u.valToPos(at, 'x', true));
  if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
  u.ctx.save();
  u.ctx.strokeStyle = u.ctx.fillStyle = ink;
  u.ctx.lineWidth = devicePixelRatio;
  u.ctx.beginPath();
  u.ctx.moveTo(x + 0.5, u.bbox.top);
  u.ctx.lineTo(x + 0.5, u.bbox.top + u.bbox.height);
  u.ctx.stroke();
  u.ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
  u.ctx.fillText(letter, x + 4 * devicePixelRatio, u.bbox.top + 12 * devicePixelRatio);
  u.ctx.restore();
}

export function Plot({curves, unit, spans, bands, range, marks, onMark, onZoom, onPixels, onCursor, sync, height, hasTimes}: Props) {
  const holder = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const latest = useRef({spans, bands, range, marks, onMark, onZoom, onPixels, onCursor, curves});
  latest.current = {spans, bands, range, marks, onMark, onZoom, onPixels, onCursor, curves};
  const shape = curves.map((c) => `${c.label}|${c.color}|${c.dash ?? ''}`).join();

  useEffect(() => {
    const element = holder.current!;
    const make = () => new uPlot(optionsNow(), dataOf(latest.current.curves), element);
    const axisNow = () => ({stroke: colour('--muted'), grid: {stroke: colour('--grid'), width: 1}, ticks: {show: false}, font: '12px system-ui, sans-serif'});
    const optionsNow = (axis = axisNow()): uPlot.Options => ({
      width: Math.max(120, element.clientWidth), height,
      scales: {x: {time: false, range: (_, low, high) => latest.current.range ?? (low === high ? [low - 1, high + 1] : [low, high])}},
      cursor: {sync: {key: sync}, drag: {x: true, y: false, setScale: false}, points: {size: 6}, y: false},
      legend: {show: false},
      axes: [{...axis, size: hasTimes ? 28 : 6, space: 60, values: (_, all) => all.map((v) => (v === null || !hasTimes ? '' : String(Number(v.toPrecision(6)))))},
             {...axis, size: 64, label: unit ? `[${unit}]` : undefined, labelSize: 18, labelFont: axis.font, labelGap: 0, values: (_, all) => all.map((v) => (v === null ? '' : String(Number(v.toPrecision(5)))))}],
      series: [{}, ...curves.map((c) => ({label: c.label, stroke: colour(c.color) || c.color, width: 1.5, dash: c.dash, spanGaps: true, points: {show: false}}))],
      hooks: {
        drawClear: [(u) => {
          const {spans: shaded, bands: allowed} = latest.current;
          for (const band of allowed ?? []) fillBand(u, band, colour('--tube'));
          if (!shaded) return;
          u.ctx.save();
          u.ctx.fillStyle = colour('--span');
          for (const [from, to] of shaded) {
            const left = Math.max(u.bbox.left, u.valToPos(from, 'x', true));
            const right = Math.min(u.bbox.left + u.bbox.width, u.valToPos(to, 'x', true));
            if (right >= left) u.ctx.fillRect(left, u.bbox.top, Math.max(2, right - left), u.bbox.height);
          }
          u.ctx.restore();
        }],
        draw: [(u) => (latest.current.marks ?? []).forEach((at, i) => at !== undefined && drawMark(u, at, 'AB'[i], colour('--text')))],
        setCursor: [(u) => {
          const row = u.cursor.idx;
          if (row === null || row === undefined) return latest.current.onCursor?.(null, {});
          const values: Record<string, number> = {};
          latest.current.curves.forEach((c, i) => {
            const value = u.data[i + 1]?.[u.cursor.idxs?.[i + 1] ?? row];
            if (value != null) values[c.label] = value;
          });
          latest.current.onCursor?.(u.data[0][row], values);
        }],
        setSelect: [(u) => {
          if (u.select.width < 4) return;
          const [a, b] = [u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x')];
          u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
          latest.current.onZoom([a, b]);
        }],
        ready: [(u) => {
          u.over.addEventListener('dblclick', () => latest.current.onZoom(null));
          u.over.addEventListener('click', (e) => latest.current.onMark?.(u.posToVal(e.offsetX, 'x')));
        }],
      },
    });
    plot.current = make();
    latest.current.onPixels?.(Math.round(plot.current.bbox.width / devicePixelRatio));
    const observer = new ResizeObserver(() => {
      plot.current?.setSize({width: Math.max(120, element.clientWidth), height});
      if (plot.current) latest.current.onPixels?.(Math.round(plot.current.bbox.width / devicePixelRatio));
    });
    observer.observe(element);
    const themed = new MutationObserver(() => {
      plot.current?.destroy();
      plot.current = make();
    });
    themed.observe(document.documentElement, {attributes: true, attributeFilter: ['data-theme']});
    return () => {
      observer.disconnect();
      themed.disconnect();
      plot.current?.destroy();
      plot.current = null;
    };
    // Made anew where the curves are others; their numbers are set below.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [shape, unit, sync, height, hasTimes]);

  useEffect(() => plot.current?.setData(dataOf(curves)), [curves, range]);
  useEffect(() => plot.current?.redraw(false), [spans, bands, marks?.[0], marks?.[1]]);

  return <div className="plot" ref={holder} />;
}
