// Decides how signals are looked at that are not drawn over time: one over the other, which shows a loop, and their
// spectra. Both of the stretch of time that the scopes show.

import {useMemo, useState} from 'react';
import type {Stretch} from '../data/api';
import {frequencyUnit} from '../numbers';
import type {Point, TraceHead} from '../types';
import {isEachRow, mostRows} from './csv';
import {useHeight} from './size';
import {spectrumOf, thinned} from './spectrum';
import {useStretch} from './traces';
import {XyPlot, type XyCurve} from './XyPlot';

const drawn = 1200;  // points of a spectrum

interface Props {
  path: string;
  head: TraceHead;
  range: Point | null;
  colourOf: (name: string, index: number) => string;
}

const middle = (c: {low: Float64Array; high: Float64Array}) => c.low.map((v, i) => (v + c.high[i]) / 2);

/// What was driven and what followed: the first input or source, and the last signal that is no residual.
export function firstLoop(names: string[]): [string, string] {
  const plain = names.filter((n) => !/_(rate|residual)$/.test(n));
  return [plain[0] ?? '', plain.find((n) => n.endsWith('_measured')) ?? plain[plain.length - 1] ?? ''];
}

export function LoopView({path, head, range, colourOf}: Props) {
  const names = useMemo(() => head.columns.slice(1).map((c) => c.name), [head]);
  const all = head.columns.map((c) => c.name);
  const [chosen, setChosen] = useState<Partial<Record<'x' | 'y', string>>>({});
  const [x, y] = [all.includes(chosen.x ?? '') ? chosen.x! : firstLoop(names)[0], all.includes(chosen.y ?? '') ? chosen.y! : firstLoop(names)[1]];
  const stretch = useStretch(path, [x, y], range, mostRows);
  const [height, holder] = useHeight(220);
  const unitOf = (name: string) => head.columns.find((c) => c.name === name)?.unit ?? '';
  // Of a measured output the simulated one is drawn as well: both loops tell where they part.
  const other = y.replace(/_measured$/, '_simulated');
  const both = useStretch(path, other !== y && names.includes(other) ? [x, other] : [], range, mostRows);
  const curveOf = (s: Stretch | null, name: string): XyCurve[] => {
    const [cx, cy] = [s?.columns.find((c) => c.name === x), s?.columns.find((c) => c.name === name)];
    return cx && cy ? [{label: `${name} over ${x}`, color: colourOf(name, names.indexOf(name)), x: middle(cx), y: middle(cy)}] : [];
  };
  const select = (which: 'x' | 'y', value: string) => (
    <label className="muted">{which} <select aria-label={`${which} of the loop`} value={value} onChange={(e) => setChosen({...chosen, [which]: e.target.value})}>{all.map((n) => <option key={n}>{n}</option>)}</select></label>
  );
  return (
    <div className="other-view">
      <div className="signals axes">{select('y', y)}{select('x', x)}</div>
      <div className="plots" ref={holder}>
        <XyPlot curves={[...curveOf(stretch, y), ...curveOf(both, other)]} x={{name: x, unit: unitOf(x)}} y={{name: y, unit: unitOf(y)}} height={Math.max(160, height - 32)}
                note={isEachRow(stretch) ? `${stretch?.x.length ?? 0} rows${range ? ' of the stretch that is zoomed in' : ''}` : 'each point is the middle between the smallest and the largest of several rows: zoom in over time for each row'} />
      </div>
    </div>
  );
}

export function SpectrumView({path, head, range, shown, colourOf}: Props & {shown: string[]}) {
  const names = useMemo(() => head.columns.slice(1).map((c) => c.name), [head]);
  const unitOf = (name: string) => head.columns.find((c) => c.name === name)?.unit ?? '';
  const units = [...new Set(shown.map(unitOf))];
  const stretch = useStretch(path, shown, range, mostRows);
  const [height, holder] = useHeight(220);
  const eachRow = isEachRow(stretch);
  const curves = useMemo(() => (stretch && eachRow ? stretch.columns : []).map((c): XyCurve & {name: string} =>
    ({name: c.name, label: c.name, color: colourOf(c.name, names.indexOf(c.name)), ...thinned(spectrumOf(stretch!.x, c.low), drawn)})), [stretch, eachRow, names, colourOf]);
  if (shown.length === 0) return <p className="empty">Tick a signal over time to see its spectrum.</p>;
  if (!eachRow) return <p className="empty">A spectrum takes each row, and here are more than {mostRows}: zoom in over time.</p>;
  return (
    <div className="plots" ref={holder}>
      {units.map((unit) => {
        const here = curves.filter((c) => unitOf(c.name) === unit);
        return (
          <XyPlot key={unit} curves={here} height={Math.max(160, Math.floor(height / units.length) - 32)}
                  x={{name: 'frequency', unit: frequencyUnit(head.columns[0].unit), logarithmic: true}} y={{name: 'amplitude', unit, logarithmic: true}}
                  note={`${here.map((c) => c.name).join(', ')}: a sine of amplitude a is a peak of height a (Hann window)`} />
        );
      })}
    </div>
  );
}
