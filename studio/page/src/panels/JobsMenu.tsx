// Decides how jobs are listed: what runs and how far it is, what was done, and the report of each.

import {useState} from 'react';
import {api} from '../data/api';
import {useStudio} from '../data/store';
import {clock, sentence, wholePercent} from '../numbers';
import type {Job} from '../types';

const words: Record<string, string> = {waiting: 'waits', running: 'runs', done: 'done', failed: 'failed', cancelled: 'stopped', lost: 'ended, nobody knows how'};

async function openReport(job: Job) {
  const tab = window.open('', '_blank');
  try {
    const url = await api.ticket(`${job.folder}/report.html`);
    if (tab) tab.location.href = url;
  } catch (error) {
    tab?.close();
    useStudio.getState().tell(error);
  }
}

function Row({job, onShow}: {job: Job; onShow: () => void}) {
  const {cancel, show, poll, tell, shownJob} = useStudio.getState();
  const runs = job.state === 'running' || job.state === 'waiting';
  const remove = async () => {
    try {
      await api.remove(job.id);
    } catch (error) {
      tell(error);
    }
    await poll();
  };
  return (
    <li className={job.id === shownJob ? 'job current' : 'job'}>
      <button className="entry" disabled={job.state !== 'done' && job.state !== 'failed'} title={`hysteron ${job.words.join(' ')}`}
              onClick={() => { void show(job.id); onShow(); }}>
        <span><b>{job.verb}</b> {job.diagram}{job.data && <span className="muted"> with {job.data}</span>}</span>
        <span className="muted">{clock(job.began)}, <span className={`state ${job.state}`}>{words[job.state]}</span>{job.stale && ' – of an earlier version'}{job.headline && ` – ${sentence(job.headline)}`}
          {job.problems[0] && ` – ${job.problems[0].what}`}</span>
        {runs && <progress max={1} {...(job.fraction >= 0 ? {value: job.fraction, title: wholePercent(job.fraction)} : {})} />}
      </button>
      <span className="acts">
        {job.state === 'done' && <button className="quiet small" onClick={() => void openReport(job)}>report</button>}
        {runs ? <button className="quiet small" onClick={() => void cancel(job.id)}>stop</button> : <button className="quiet small" title="remove this job and its results" onClick={() => void remove()}>×</button>}
      </span>
    </li>
  );
}

export function JobsMenu() {
  const jobs = useStudio((s) => s.jobs);
  const [open, setOpen] = useState(false);
  const running = jobs.filter((j) => j.state === 'running' || j.state === 'waiting');
  const label = running.length ? `${running[0].verb} ${running[0].fraction >= 0 ? wholePercent(running[0].fraction) : '…'}` : jobs.length === 1 ? '1 job' : `${jobs.length} jobs`;
  return (
    <div className="menu">
      <button aria-expanded={open} onClick={() => setOpen(!open)}>{running.length > 0 && <span className="spinner" />}{label}</button>
      {open && (
        <>
          <div className="shade" onClick={() => setOpen(false)} />
          <ul className="popup jobs" aria-label="jobs">
            {jobs.length === 0 && <li className="empty">Nothing was run yet.</li>}
            {jobs.map((job) => <Row key={job.id} job={job} onShow={() => setOpen(false)} />)}
          </ul>
        </>
      )}
    </div>
  );
}
