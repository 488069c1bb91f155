// Decides how what is wrong is told: of the file, and of the job that failed.

import {useStudio} from '../data/store';
import type {Problem} from '../types';

function List({problems, kind}: {problems: Problem[]; kind: 'problem' | 'warning'}) {
  const set = useStudio((s) => s.set);
  const view = useStudio((s) => s.view);
  return (
    <ul className="problems">
      {problems.map((p, i) => {
        const name = /^\/blocks\/([^/]+)/.exec(p.path)?.[1] ?? '';
        const there = view?.sheet?.items.some((item) => item.path === name);
        return (
          <li key={i}>
            <button className="entry" disabled={!there && !p.line} title={there ? 'show it on the canvas; twice: in the text' : p.line ? 'show it in the text' : undefined}
                    onClick={() => set(there ? {selected: [name], selectedWire: ''} : {tab: 'text', line: p.line ?? 0})} onDoubleClick={() => p.line && set({tab: 'text', line: p.line})}>
              <span className={`mark ${kind}`} />
              <span><b>{p.line ? `line ${p.line}, ` : ''}{p.path}</b> {p.what}<br /><span className="muted">{p.cure}</span></span>
            </button>
          </li>
        );
      })}
    </ul>
  );
}

export function Problems() {
  const view = useStudio((s) => s.view);
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const ofJob = job?.state === 'failed' ? job.problems : [];
  const none = !view?.problems.length && !view?.warnings.length && !ofJob.length;
  return (
    <div className="panel-body scroll">
      {none && <div className="start"><p>Nothing is wrong.</p></div>}
      {ofJob.length > 0 && <><h3>{job!.verb} failed</h3><List problems={ofJob} kind="problem" /></>}
      {(view?.problems.length ?? 0) > 0 && <List problems={view!.problems} kind="problem" />}
      {(view?.warnings.length ?? 0) > 0 && <><h3>unfinished</h3><List problems={view!.warnings} kind="warning" /></>}
    </div>
  );
}
