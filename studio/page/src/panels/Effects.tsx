// Decides how a diagnosis is shown: a card per effect that is missing, with where it stands, what it takes away and how
// sure its numbers are; below it what was tried, and what could not be seen.

import {useStudio} from '../data/store';
import {accept, tryStep} from '../edit/actions';
import {lengthText, sentence, withUnit} from '../numbers';
import type {Candidate, DiscoveryStep, Result} from '../types';
import {StartHint} from './StartHint';

const verdicts: Record<string, string> = {
  missing_effect: 'an effect is missing',
  adequate: 'the model is adequate',
  not_distinguishable: 'several effects explain it equally well',
  unexplained: 'something is missing, and no known effect explains it',
};

const shownNumbers = 6;  // the report holds all

function Numbers({candidate}: {candidate: Candidate}) {
  const told = candidate.found.filter((f) => f.determined);
  const others = candidate.found.length - told.length;
  return (
    <>
      <table className="numbers">
        <tbody>
          {told.slice(0, shownNumbers).map((f) => (
            <tr key={f.parameter}>
              <td>{f.parameter}</td><td>{withUnit(f.value, f.unit)}</td>
              <td className="muted">{f.low95 !== null && f.high95 !== null ? `${withUnit(f.low95, '')} … ${withUnit(f.high95, f.unit)}` : ''}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {told.length > shownNumbers && <p className="muted">and {told.length - shownNumbers} more, in the report</p>}
      {others > 0 && <p className="muted">{others} {others === 1 ? 'number is' : 'numbers are'} at a bound or not determined by these data</p>}
    </>
  );
}

function Card({step, job, file}: {step: DiscoveryStep; job: string; file: string}) {
  const set = useStudio((s) => s.set);
  const trial = useStudio((s) => s.trial);
  const isTried = trial?.job === job && trial.file === file;
  const mark = (on: boolean) => set({highlighted: on ? [step.place, step.block] : []});
  return (
    <article className={isTried ? 'card tried' : 'card'} onMouseEnter={() => mark(true)} onMouseLeave={() => mark(false)}>
      <header>
        <strong>{step.effect.replace(/_/g, ' ')}</strong> <span className="muted">at {step.place}</span>
        <span className="fall"><s>{lengthText(step.before.rms_validate, step.before.unit)}</s> → <b>{lengthText(step.after.rms_validate, step.after.unit)}</b></span>
      </header>
      <p>{sentence(step.sentence)}</p>
      {step.ties.length > 0 && (
        <p className="tie">Explains it as well: {step.ties.map((t) => `${t.effect} at ${t.place}`).join(', ')}.
          {step.experiment_would_tell ? ' The report says which experiment would tell them apart.' : ''}</p>
      )}
      <footer>
        {isTried ? (
          <>
            <button className="primary" onClick={() => void accept()}>Accept</button>
            <button onClick={() => set({trial: null})}>Discard</button>
            <span className="muted">{trial!.edits.length} {trial!.edits.length === 1 ? 'change' : 'changes'}, not yet written</span>
          </>
        ) : (
          <button onClick={() => void tryStep(job, file, step.effect)}>Try</button>
        )}
      </footer>
      <Numbers candidate={step.evidence} />
    </article>
  );
}

function Tried({result}: {result: Result}) {
  const rejected = (result.facts.candidates ?? []).filter((c) => !c.claimed);
  const unseen = result.facts.inspection?.cannot_show ?? [];
  return (
    <div className="looked-for">
      <h3>looked for and not found</h3>
      <table className="numbers">
        <tbody>{rejected.slice(0, 40).map((c, i) => <tr key={i}><td>{c.effect}</td><td className="muted">{c.place}</td><td>{c.failed ? 'could not be fitted' : c.reason}</td></tr>)}</tbody>
      </table>
      {unseen.length > 0 && <h3>not visible in these data</h3>}
      <table className="numbers"><tbody>{unseen.map((c, i) => <tr key={i}><td>{c.effect}</td><td>{c.reason}</td></tr>)}</tbody></table>
    </div>
  );
}

export function Effects() {
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const result = useStudio((s) => s.results[s.shownJob]);
  if (!job || !result || !result.facts.steps) return <StartHint verb="discover" what="the effects that are missing in the model" />;
  const files = result.files.filter((f) => /^step\d+_/.test(f));
  return (
    <>
      <div className="panel-head">
        <span className={`verdict ${result.verdict}`}>{verdicts[result.verdict] ?? result.verdict}</span>
        <span className="headline" title={sentence(result.headline)}>{sentence(result.headline)}</span>
      </div>
      <div className="effects">
        <div className="cards">
          {result.facts.steps.length === 0 && result.sentences.map((s, i) => <p key={i}>{sentence(s)}</p>)}
          {result.facts.steps.map((step) => (
            <Card key={step.step} step={step} job={job.id} file={files.find((f) => f.startsWith(`step${step.step}_`)) ?? 'final.json'} />
          ))}
        </div>
        <Tried result={result} />
      </div>
    </>
  );
}
