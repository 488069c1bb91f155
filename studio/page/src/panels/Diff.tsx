// Decides how two diagrams are held against each other: what differs, place by place, and both of them run.

import {useEffect, useMemo, useState} from 'react';
import {api} from '../data/api';
import {currentPath, useStudio} from '../data/store';
import {compareRuns} from '../edit/actions';
import {changesOf, type Change} from '../edit/changes';
import {runOrder} from '../edit/orders';

const sections: Record<string, string> = {blocks: '', parameters: 'parameter ', inputs: 'input ', outputs: 'output ', simulate: 'simulate '};
const placeOf = (c: Change) => `${c.section in sections ? sections[c.section] : `${c.section} `}${c.name}`.trim() || c.section;

export function Diff() {
  const path = useStudio(currentPath);
  const mine = useStudio((s) => s.document);
  const view = useStudio((s) => s.view);
  const trial = useStudio((s) => s.trial);
  const files = useStudio((s) => s.files);
  const data = useStudio((s) => s.data);
  const wanted = useStudio((s) => s.other);
  const {set, tell} = useStudio.getState();
  const others = files.filter((f) => f.kind === 'diagram' && f.path !== path);
  const other = others.some((f) => f.path === wanted) ? wanted : '';
  const [text, setText] = useState('');
  useEffect(() => {
    setText('');
    if (trial || !other) return;
    let asked = true;
    api.read(other).then((t) => asked && setText(t), (e) => asked && tell(e));
    return () => {
      asked = false;
    };
  }, [other, trial, view, tell]);
  const theirs = useMemo(() => {
    try {
      return trial ? JSON.parse(trial.view.text) : text ? JSON.parse(text) : null;
    } catch {
      return null;
    }
  }, [trial, text]);
  const changes = useMemo(() => (mine && theirs ? changesOf(mine, theirs) : []), [mine, theirs]);
  const mark = (c: Change | null) => set({highlighted: c?.section === 'blocks' ? [c.name] : []});
  const select = (c: Change) => c.section === 'blocks' && mine?.blocks?.[c.name] && set({selected: [c.name], selectedWire: ''});
  return (
    <>
      <div className="panel-head">
        <span className="headline">{theirs ? `${changes.length} ${changes.length === 1 ? 'difference' : 'differences'}` : 'What another diagram has otherwise'}</span>
        {trial ? <span className="muted">with {trial.title.replace(/_/g, ' ')}, not yet written</span> : (
          <label className="muted with-data">against <select aria-label="other diagram" value={other} onChange={(e) => set({other: e.target.value})}>
            <option value="">choose a diagram</option>
            {others.map((f) => <option key={f.path}>{f.path}</option>)}
          </select></label>
        )}
        {!trial && other && <button title="run both; the other one is drawn dashed" onClick={() => void compareRuns([runOrder(other, data, theirs), runOrder(path, data, mine)])}>Run both</button>}
      </div>
      {!theirs ? <div className="start"><p>{others.length ? 'Choose a diagram of this folder: here stands what it has otherwise.' : 'There is no other diagram in this folder.'}</p></div> : (
        <div className="scroll">
          <table className="diff">
            <thead><tr><th>where</th><th>{path}</th><th>{trial ? trial.title.replace(/_/g, ' ') : other}</th></tr></thead>
            <tbody>
              {changes.map((c, i) => (
                <tr key={i} className={c.kind} onMouseEnter={() => mark(c)} onMouseLeave={() => mark(null)} onClick={() => select(c)}>
                  <td>{placeOf(c)}{c.member && <span className="muted"> {c.member}</span>}</td>
                  <td>{c.before || <span className="muted">–</span>}</td>
                  <td>{c.after || <span className="muted">–</span>}</td>
                </tr>
              ))}
            </tbody>
          </table>
          {changes.length === 0 && <p className="empty">Both say the same.</p>}
        </div>
      )}
    </>
  );
}
