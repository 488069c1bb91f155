// Decides how the fall of the error is drawn: from the model as it was, step by step, down to the noise.

import {useStudio} from '../data/store';
import {tryStep} from '../edit/actions';
import {lengthText, sentence} from '../numbers';
import {StartHint} from './StartHint';

interface Bar {
  label: string;
  rms: number;
  file: string;
}

export function Waterfall() {
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const result = useStudio((s) => s.results[s.shownJob]);
  const set = useStudio((s) => s.set);
  if (!job || !result?.facts.steps || !result.facts.base) return <StartHint verb="discover" what="the error, falling step by step" />;
  const unit = result.facts.base.unit;
  const files = result.files;
  const bars: Bar[] = [
    {label: 'as given', rms: (result.facts.as_given ?? result.facts.base).rms_validate, file: ''},
    ...result.facts.steps.map((s) => ({label: `+ ${s.effect.replace(/_/g, ' ')}`, rms: s.after.rms_validate, file: files.find((f) => f.startsWith(`step${s.step}_`)) ?? ''})),
  ];
  const floor = result.facts.floor?.[0]?.noise_rms ?? 0;
  const width = 640, height = 168, left = 8, base = 136, top = 22;
  const all = [...bars.map((b) => b.rms), ...(floor > 0 ? [floor] : [])].filter((v) => v > 0);
  const low = Math.log10(Math.min(...all)) - 0.4;
  const high = Math.log10(Math.max(...all));
  const y = (rms: number) => base - ((Math.log10(rms) - low) / Math.max(high - low, 1e-9)) * (base - top);
  const step = Math.min(150, (width - left - 120) / bars.length);
  return (
    <>
      <div className="panel-head"><span className="headline" title={sentence(result.headline)}>{sentence(result.headline)}</span></div>
      <div className="waterfall">
        <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label="the error, step by step, logarithmic">
          <line className="axis" x1={left} x2={width - 8} y1={base} y2={base} />
          {bars.map((bar, i) => (
            <g key={i} className={bar.file ? 'bar-step click' : 'bar-step'} onClick={() => (bar.file ? void tryStep(job.id, bar.file, bar.label) : set({trial: null}))}>
              <title>{bar.file ? 'show this diagram on the canvas' : 'show the diagram as it is'}</title>
              <rect className={i === 0 ? 'before' : 'after'} x={left + i * step + 8} y={y(bar.rms)} width={step - 24} height={base - y(bar.rms)} />
              {i > 0 && <line className="link" x1={left + (i - 1) * step + 8} x2={left + (i + 1) * step - 16} y1={y(bars[i - 1].rms)} y2={y(bars[i - 1].rms)} />}
              <text className="value" x={left + i * step + 8 + (step - 24) / 2} y={y(bar.rms) - 6}>{lengthText(bar.rms, unit)}</text>
              <text className="label" x={left + i * step + 8 + (step - 24) / 2} y={base + 16}>{bar.label}</text>
            </g>
          ))}
          {floor > 0 && (
            <g className="floor">
              <line x1={left} x2={width - 8} y1={y(floor)} y2={y(floor)} />
              <text x={width - 8} y={y(floor) - 5}>noise {lengthText(floor, unit)}</text>
            </g>
          )}
        </svg>
        <p className="hint">RMS on recordings that were not fitted, logarithmic. Click a bar to see that diagram.</p>
      </div>
    </>
  );
}
