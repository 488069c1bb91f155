// Decides how it is shown where a model fails: the error split by what the recordings did, and the spans of time that a
// bar stands for, shaded over the curves.

import {useState} from 'react';
import {useStudio} from '../data/store';
import {lengthText, percent, sentence} from '../numbers';
import type {Metric, Split} from '../types';
import {StartHint} from './StartHint';
import {TraceView} from './Scopes';

/// How much more of the error than of the rows the worst part holds: what a split says.
const tells = (split: Split) => Math.max(...split.parts.map((p) => p.share_of_squared_error - p.share_of_rows));

function Metrics({metrics}: {metrics: Metric[]}) {
  const recording = useStudio((s) => s.recording);
  const set = useStudio((s) => s.set);
  return (
    <table className="metrics">
      <thead><tr><th>recording</th><th>role</th><th>RMS</th><th>NRMSE</th></tr></thead>
      <tbody>
        {metrics.map((m, i) => (
          <tr key={i} className={m.recording === recording ? 'current' : m.recording === 'all' ? 'sum' : ''} onClick={() => m.recording !== 'all' && set({recording: m.recording, spans: null})}>
            <td>{m.recording === 'all' ? `all ${m.role === 'all' ? '' : m.role}` : m.recording}</td><td>{m.role}</td><td>{lengthText(m.rms, m.unit)}</td><td>{percent(m.nrmse)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function Fails() {
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const result = useStudio((s) => s.results[s.shownJob]);
  const spans = useStudio((s) => s.spans);
  const recording = useStudio((s) => s.recording);
  const set = useStudio((s) => s.set);
  const begin = useStudio((s) => s.begin);
  const splits = result?.facts.splits ?? result?.facts.splits_before ?? [];
  const [by, setBy] = useState('');
  if (!job || job.state !== 'done' || !result || splits.length === 0)
    return <StartHint verb="compare" what="the error of the model on the recordings, and when it is large" />;
  const keyOf = (s: Split) => `${s.by} of ${s.output}`;
  const several = new Set(splits.map((s) => s.output)).size > 1;
  const sorted = [...splits].sort((a, b) => tells(b) - tells(a));
  const split = splits.find((s) => keyOf(s) === by) ?? sorted[0];
  const widest = Math.max(...split.parts.map((p) => Math.max(p.share_of_squared_error, p.share_of_rows)));
  const file = result.traces.includes(recording) ? recording : result.traces[0];
  const shaded = spans?.spans.find((s) => s.recording === file)?.seconds;
  return (
    <>
      <div className="panel-head">
        <span className="headline" title={sentence(result.headline)}>{sentence(result.headline)}</span>
        <label className="muted">split by <select aria-label="split by" value={keyOf(split)} onChange={(e) => { setBy(e.target.value); set({spans: null}); }}>
          {sorted.map((s) => <option key={keyOf(s)} value={keyOf(s)}>{s.by.replace('_', ' ')}{several ? ` (${s.output})` : ''}</option>)}
        </select></label>
        <select aria-label="recording" value={file} onChange={(e) => set({recording: e.target.value})}>{result.traces.map((t) => <option key={t}>{t}</option>)}</select>
      </div>
      <div className="fails">
        <div className="bars-and-table">
          <ul className="bars" aria-label={`error by ${split.by}`}>
            {split.parts.map((part) => (
              <li key={part.label}>
                <button className={spans?.label === part.label ? 'bar-row current' : 'bar-row'} title={`${percent(part.share_of_squared_error)} of the squared error in ${percent(part.share_of_rows)} of the rows; click to see when`}
                        onClick={() => {
                          const here = part.spans.some((s) => s.recording === file) ? file : part.spans[0]?.recording ?? file;
                          set({spans: {label: part.label, spans: part.spans}, recording: here});
                        }}>
                  <span className="bar-label">{part.label}</span>
                  <span className="bar-track">
                    <span className="bar-fill" style={{width: `${(100 * part.share_of_squared_error) / widest}%`}} />
                    <span className="bar-mark" style={{left: `${(100 * part.share_of_rows) / widest}%`}} />
                  </span>
                  <span className="bar-value">{percent(part.share_of_squared_error)}</span>
                </button>
              </li>
            ))}
          </ul>
          {spans && job.data && (
            <button title="simulate the model along the recordings and record every signal: what each block did then"
                    onClick={() => void begin({verb: 'run', diagram: job.diagram, options: {'--data': job.data, '--record': 'all'}})}>All signals along {file}</button>
          )}
          <p className="hint">Bars: share of the squared error. Marks: share of the rows.</p>
          {result.facts.metrics && <Metrics metrics={result.facts.metrics} />}
        </div>
        <TraceView path={`${job.folder}/traces/${file}`} spans={shaded} />
      </div>
    </>
  );
}
