// Decides which curves the scopes show: those of the run that is looked at, one plot per unit, pinned runs behind it.

import {useCallback, useEffect, useMemo, useState} from 'react';
import {useStudio} from '../data/store';
import type {Stretch} from '../data/api';
import {looking} from '../data/live';
import {clock, sentence} from '../numbers';
import type {Job, Point} from '../types';
import {Plot, type Curve} from './Plot';
import {useCursors} from './cursors';
import {LoopView, SpectrumView} from './OtherViews';
import {Signals} from './Signals';
import {useHeight} from './size';
import {saveCsv, useHead, useStretch, useStretches} from './traces';
import type {Tube} from './tolerance';
import {useTubes} from './tube';
import {StartHint} from './StartHint';

export const colours = ['--curve-1', '--curve-2', '--curve-3', '--curve-4', '--curve-5', '--curve-6'];
const shownAtFirst = 6;
const dashes = [[5, 4], [2, 3], [9, 4], [9, 3, 2, 3]];  // of runs that lie behind the one that is looked at

/// Of compare: what is measured, simulated and left over has the same colour everywhere.
export function colourOf(name: string, index: number): string {
  if (name.endsWith('_measured')) return '--measured';
  if (name.endsWith('_simulated')) return '--simulated';
  if (name.endsWith('_residual')) return '--residual';
  return colours[index % colours.length];
}

export function curvesOf(stretch: Stretch | null, names: string[], order: string[], suffix = '', dash?: number[]): Curve[] {
  if (!stretch) return [];
  return names.flatMap((name) => {
    const column = stretch.columns.find((c) => c.name === name);
    if (!column) return [];
    return [{label: name + suffix, color: colourOf(name, order.indexOf(name)), dash, x: stretch.x, low: column.low, high: column.high}];
  });
}

/// The rate of an input is told, and seldom looked at.
const isAside = (name: string) => name.endsWith('_rate');
/// What is left over is small: it has a scale of its own.
const isResidual = (name: string) => name.endsWith('_residual');

export interface Pinned {
  path: string;
  label: string;
}

export type Look = 'time' | 'loop' | 'spectrum';

interface TraceViewProps {
  path: string;
  spans?: Point[];
  pinned?: Pinned[];
  tubes?: Record<string, Tube>;
  look?: Look;
  withCursors?: boolean;
}

export function TraceView({path, spans, pinned = [], tubes, look = 'time', withCursors = false}: TraceViewProps) {
  const head = useHead(path);
  const [hidden, setHidden] = useState<Set<string> | null>(null);
  const [range, setRange] = useState<Point | null>(null);
  const [pixels, setPixels] = useState(800);
  const [height, holder] = useHeight(220);
  useEffect(() => {
    setRange(null);
    setHidden(null);
  }, [path]);
  const names = useMemo(() => head?.columns.slice(1).map((c) => c.name) ?? [], [head]);
  const off = hidden ?? new Set([...names.filter(isAside), ...names.filter((n) => !isAside(n)).slice(shownAtFirst)]);
  const [cursor, setCursor] = useState<{at: number | null; values: Record<string, number>}>({at: null, values: {}});
  const shown = names.filter((n) => !off.has(n));
  const stretch = useStretch(path, shown, range, pixels);
  const others = useStretches(pinned, shown, range, pixels);
  const answer = useStudio((s) => s.live);
  const live = answer && path.endsWith(`/${answer.trace}`) ? answer : null;
  useEffect(() => {
    Object.assign(looking, {trace: path.slice(path.lastIndexOf('/') + 1), columns: shown, range, pixels});
  });
  // Told at each move of the mouse, and whenever a curve gets other numbers: only what is new is drawn anew.
  const onCursor = useCallback((at: number | null, values: Record<string, number>) => setCursor((now) => {
    if (at === null) return now.at === null ? now : {at: null, values: {}};
    if (now.at !== at) return {at, values};
    return Object.entries(values).every(([name, v]) => now.values[name] === v) ? now : {at, values: {...now.values, ...values}};
  }), []);
  const groupOf = (c: {name: string; unit: string}) => (isResidual(c.name) ? `residual ${c.unit}` : c.unit);
  const plots = useMemo(() => {
    const columns = head?.columns.slice(1).filter((c) => shown.includes(c.name)) ?? [];
    return [...new Set(columns.map(groupOf))].map((group) => {
      const here = columns.filter((c) => groupOf(c) === group);
      const order = here.map((c) => c.name);
      return {
        group, unit: here[0].unit, bands: order.flatMap((name) => (tubes?.[name] ? [tubes[name]] : [])),
        curves: [...curvesOf(live?.stretch ?? stretch, order, names),
                 ...(live ? curvesOf(stretch, order, names, ' (before)', dashes[0]) : []),
                 ...pinned.flatMap((p, i) => curvesOf(others[i] ?? null, order, names, ` (${p.label})`, dashes[i % dashes.length]))],
      };
    });
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [head, shown.join('\n'), live, stretch, others, tubes, pinned.map((p) => p.label).join('\n')]);
  const whole: Point | null = useMemo(() => range ?? (head && head.from !== null && head.to !== null ? [head.from, head.to] : null), [range, head]);
  const cursors = useCursors(withCursors && look === 'time', path, names, whole);
  if (!head) return <div className="panel-body" ref={holder} />;
  if (look === 'loop') return <div className="scopes"><LoopView path={path} head={head} range={range} colourOf={colourOf} /></div>;
  const each = Math.max(76, Math.floor((height - 28) / Math.max(1, plots.length)));
  return (
    <div className="scopes">
      <Signals head={head} off={off} onOff={setHidden} colourOf={colourOf} at={cursor} cursors={cursors}>
        {range && <li><button className="quiet small" onClick={() => setRange(null)}>show all</button></li>}
        {shown.length > 0 && <li><button className="quiet small" title="the rows of the signals that are ticked, as far as they are in sight" onClick={() => void saveCsv(path, head, shown, range)}>save as CSV</button></li>}
        {live && <li className="following" aria-live="off">{live.label}<br /><span className="muted">dashed: before</span></li>}
        {pinned.map((p, i) => <li key={p.path} className="pinned"><svg width={22} height={8} aria-hidden><line x1={0} x2={22} y1={4} y2={4} strokeDasharray={dashes[i % dashes.length].join(' ')} /></svg> {p.label}</li>)}
      </Signals>
      {look === 'spectrum' ? <SpectrumView path={path} head={head} range={range} shown={shown} colourOf={colourOf} /> : <div className="plots" ref={holder}>
        {shown.length === 0 && <p className="empty">Tick a signal to see it.</p>}
        {plots.map((p, k) => (
          <Plot key={p.group} unit={p.unit} height={k === plots.length - 1 ? each + 22 : each} hasTimes={k === plots.length - 1} sync={path} range={range} spans={spans} bands={p.bands} curves={p.curves}
                marks={cursors ? [cursors.first?.at, cursors.second?.at] : undefined} onMark={cursors?.put} onZoom={setRange} onPixels={setPixels} onCursor={onCursor} />
        ))}
      </div>}
    </div>
  );
}

const looks: {look: Look; label: string; tip: string}[] = [
  {look: 'time', label: 'Over time', tip: 'curves over time'},
  {look: 'loop', label: 'Loop', tip: 'one signal over another'},
  {look: 'spectrum', label: 'Spectrum', tip: 'amplitudes over frequency of the signals that are ticked'},
];

/// What a pinned run was: what its command line has that the one that is looked at has not, else when it began.
export function runLabel(job: Job, shown: Job): string {
  const values = (j: Job, name: string) => [j.asked.options?.[name] ?? []].flat().map(String);
  const own = ['--choose', '--set'].flatMap((name) => values(job, name).filter((v) => !values(shown, name).includes(v)));
  return own.join(', ') || clock(job.began);
}

const rememberedTolerance = 'hysteron.tolerance';

export function Scopes() {
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const jobs = useStudio((s) => s.jobs);
  const result = useStudio((s) => s.results[s.shownJob]);
  const recording = useStudio((s) => s.recording);
  const pinnedIds = useStudio((s) => s.pinnedJobs);
  const headline = useStudio((s) => s.live?.headline);
  const set = useStudio((s) => s.set);
  const [tolerance, setTolerance] = useState(() => localStorage.getItem(rememberedTolerance) ?? '');
  const [text, setText] = useState(tolerance);
  const [look, setLook] = useState<Look>('time');
  const [withCursors, setWithCursors] = useState(false);
  const file = result?.traces.includes(recording) ? recording : result?.traces[0] ?? '';
  const pinned = job ? pinnedIds.filter((id) => id !== job.id).flatMap((id) => {
    const other = jobs.find((j) => j.id === id);
    return other && other.state === 'done' ? [{path: `${other.folder}/traces/${file}`, label: runLabel(other, job)}] : [];
  }) : [];
  const path = job ? `${job.folder}/traces/${file}` : '';
  const {tubes, verdict, wrong} = useTubes(pinned[0]?.path ?? '', path, pinned.length ? tolerance : '');
  if (!job || job.state !== 'done' || !result) return <StartHint verb="run" what="curves of the signals that the diagram records" />;
  const commit = () => {
    localStorage.setItem(rememberedTolerance, text.trim());
    setTolerance(text.trim());
  };
  return (
    <>
      <div className="panel-head">
        <span className="headline" title={sentence(headline || job.headline)}>{sentence(verdict || headline || job.headline)}</span>
        {look === 'time' && <button className={withCursors ? 'on' : ''} aria-pressed={withCursors} title="two cursors, and what lies between: a click puts the nearer one there" onClick={() => setWithCursors(!withCursors)}>Cursors</button>}
        <div className="group" role="radiogroup" aria-label="how curves are looked at">
          {looks.map((l) => <button key={l.look} role="radio" aria-checked={l.look === look} className={l.look === look ? 'on' : ''} title={l.tip} onClick={() => setLook(l.look)}>{l.label}</button>)}
        </div>
        {pinned.length > 0 && (
          <label className={wrong ? 'muted tolerance wrong' : 'muted tolerance'} title={wrong || 'how far the curves may be from the pinned ones: value, share, time beside it'}>within{' '}
            <input className="field" aria-label="tolerance" value={text} placeholder="2 nm + 0.1 %, 0.1 ms" spellCheck={false}
                   onChange={(e) => setText(e.target.value)} onBlur={commit} onKeyDown={(e) => e.key === 'Enter' && e.currentTarget.blur()} /></label>
        )}
        {result.traces.length > 1 && (
          <select aria-label="recording" value={file} onChange={(e) => set({recording: e.target.value})}>
            {result.traces.map((t) => <option key={t}>{t}</option>)}
          </select>
        )}
        {job.verb === 'run' && (
          <button className={pinnedIds.includes(job.id) ? 'on' : ''} title="keep this run behind the next ones, dashed"
                  onClick={() => set({pinnedJobs: pinnedIds.includes(job.id) ? [] : [job.id]})}>{pinnedIds.includes(job.id) ? 'Pinned' : 'Pin'}</button>
        )}
      </div>
      {wrong && <p className="problem tolerance-problem">{wrong}</p>}
      <TraceView path={path} pinned={pinned} tubes={tubes} look={look} withCursors={withCursors} />
    </>
  );
}
