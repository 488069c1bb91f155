// Decides how recordings come in: dropped on the page they are looked at, what they leave open is asked, and then they
// start a diagram of their own or join the data set that is chosen; and which recordings of that train or validate.

import {useCallback, useEffect, useMemo, useRef, useState} from 'react';
import {api, Conflict} from '../data/api';
import {useStudio} from '../data/store';
import {controlsFor, folderFor, missingColumns, noChoices, optionsOf, roleOf, type Choices, type Role} from '../edit/recording';
import {jsonText, pointer} from '../edit/document';
import {short, withUnit} from '../numbers';
import type {Problem, RecordingPreview} from '../types';
import {Field} from './Inspector';

/// Files that were dropped or chosen: kept aside by the server, and looked at in the tab Data.
export async function takeIn(files: File[]): Promise<void> {
  const {set, say, tell} = useStudio.getState();
  const diagrams = files.filter((f) => f.name.endsWith('.json'));
  if (diagrams.length) say(`${diagrams[0].name} is no recording: put diagrams and data sets into the folder, then they stand in the list of files`, 'error');
  const kept: string[] = [];
  for (const file of files.filter((f) => !f.name.endsWith('.json'))) {
    try {
      kept.push(await api.upload(file));
    } catch (error) {
      tell(error);
    }
  }
  if (kept.length) set({dropped: [...new Set([...kept, ...useStudio.getState().dropped])], tab: 'data'});
}

const labelOf = (file: string) => file.split('/').pop() ?? file;

function Sparkline({low, high}: {low: (number | null)[]; high: (number | null)[]}) {
  const all = [...low, ...high].filter((v): v is number => v !== null);
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const x = (i: number) => (i / Math.max(1, low.length - 1)) * 118 + 1;
  const y = (v: number | null) => 19 - (((v ?? least) - least) / (most - least || 1)) * 18;
  const points = [...high.map((v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`), ...low.map((v, i) => `${x(i).toFixed(1)},${(y(v) + 0.5).toFixed(1)}`).reverse()];
  return <svg className="sparkline" width={120} height={20} aria-hidden><polygon points={points.join(' ')} /></svg>;
}

function Columns({preview, choices, onChoices}: {preview: RecordingPreview; choices: Choices; onChoices: (c: Choices) => void}) {
  const setRole = (name: string, role: Role) => onChoices({...choices, roles: {...choices.roles, [name]: role}});
  const setUnit = (name: string, unit: string) => onChoices({...choices, units: {...choices.units, [name]: unit}});
  const left = Object.entries(choices.roles).filter(([name, role]) => role === 'without' && !preview.columns.some((c) => c.name === name)).map(([name]) => name);
  if (preview.columns.length === 0) {
    return (
      <table className="columns raw">
        <thead><tr>{preview.raw.map((c, i) => <th key={i}>{c.name || `column ${i + 1}`}{c.unit && <span className="muted"> [{c.unit}]</span>}</th>)}</tr></thead>
        <tbody>{Array.from({length: Math.max(0, ...preview.raw.map((c) => c.values.length))}, (_, k) => (
          <tr key={k}>{preview.raw.map((c, i) => <td key={i}>{c.values[k] === null || c.values[k] === undefined ? '–' : short(c.values[k]!, 6)}</td>)}</tr>
        ))}</tbody>
      </table>
    );
  }
  return (
    <table className="columns">
      <thead><tr><th>column</th><th>unit</th><th>role</th><th>from</th><th>to</th><th /></tr></thead>
      <tbody>
        {preview.columns.map((c) => c.name === 't' ? (
          <tr key="t"><td>t</td><td>{c.unit}</td><td className="muted">time</td><td>{short(c.smallest, 6)}</td><td>{short(c.largest, 6)}</td><td /></tr>
        ) : (
          <tr key={c.name}>
            <td title={c.name}>{c.name}</td>
            <td><Field label={`unit of ${c.name}`} value={choices.units[c.name] ?? c.unit} placeholder="none" onCommit={(unit) => setUnit(c.name, unit)} /></td>
            <td><select aria-label={`role of ${c.name}`} value={roleOf(c.name, preview, choices)} onChange={(e) => setRole(c.name, e.target.value as Role)}>
              <option value="input">drives</option><option value="output">measured</option><option value="other">beside</option><option value="without">left out</option>
            </select></td>
            <td>{short(c.smallest)}</td><td>{short(c.largest)}</td>
            <td><Sparkline low={c.low} high={c.high} /></td>
          </tr>
        ))}
        {left.map((name) => (
          <tr key={name} className="muted"><td>{name}</td><td /><td><select aria-label={`role of ${name}`} value="without" onChange={(e) => setRole(name, e.target.value as Role)}>
            <option value="other">beside</option><option value="without">left out</option></select></td><td colSpan={3} /></tr>
        ))}
      </tbody>
    </table>
  );
}

/// What is open, with what answers it.
function Question({problem, preview, choices, onChoices}: {problem: Problem; preview: RecordingPreview; choices: Choices; onChoices: (c: Choices) => void}) {
  const names = preview.raw.map((c) => c.name).filter(Boolean);
  const text = (key: 'interval' | 'names' | 'sheet' | 'group', label: string, placeholder: string) => (
    <label key={key}>{label} <Field label={label} value={choices[key]} placeholder={placeholder} onCommit={(value) => onChoices({...choices, [key]: value})} /></label>
  );
  const control = {
    time: <label key="time">the time is <select aria-label="time column" value={choices.time} onChange={(e) => onChoices({...choices, time: e.target.value})}><option value="">choose</option>{names.map((n) => <option key={n}>{n}</option>)}</select></label>,
    decimal: <span key="decimal" className="segments">{['point', 'comma'].map((sign) => <button key={sign} className={choices.decimal === sign ? 'on' : ''} onClick={() => onChoices({...choices, decimal: sign})}>decimal {sign}</button>)}</span>,
    interval: text('interval', 'rows are apart by', '1 ms'),
    names: text('names', 'headings', 't [s],u [V],y [um]'),
    sheet: text('sheet', 'sheet', ''),
    group: text('group', 'table', ''),
    unit: <label key="unit">unit of {problem.path} <Field label={`answer unit of ${problem.path}`} value={choices.units[problem.path] ?? ''} placeholder="um" onCommit={(unit) => onChoices({...choices, units: {...choices.units, [problem.path]: unit}})} /></label>,
    without: <button key="without" onClick={() => onChoices({...choices, roles: {...choices.roles, [problem.path]: 'without'}})}>Leave {problem.path} out</button>,
    roles: <span key="roles" className="muted">Say in the table which column drives and which was measured.</span>,
  };
  const controls = controlsFor(problem).filter((c) => c !== 'without' || names.includes(problem.path));
  return (
    <div className="question">
      <p>{problem.what}{problem.line && problem.line > 1 ? <span className="muted"> (line {problem.line})</span> : null}</p>
      {controls.length ? <div className="answers">{controls.map((c) => control[c])}</div> : <p className="muted">{problem.cure}</p>}
    </div>
  );
}

function Preview({files}: {files: string[]}) {
  const {set, tell, say, refresh, open} = useStudio.getState();
  const data = useStudio((s) => s.data);
  const datasets = useStudio((s) => s.files).filter((f) => f.kind === 'dataset');
  const [shown, setShown] = useState(files[0]);
  const file = files.includes(shown) ? shown : files[0];
  const [choices, setChoices] = useState<Choices>(noChoices);
  const [preview, setPreview] = useState<RecordingPreview | null>(null);
  const [folder, setFolder] = useState(folderFor(files[0]));
  const [role, setRole] = useState('train');
  const [busy, setBusy] = useState(false);
  const dataset = datasets.some((d) => d.path === data) ? data : datasets[0]?.path ?? '';
  const [wanted, setWanted] = useState<any>(null);
  const latest = useRef(preview);
  latest.current = preview;
  useEffect(() => {
    let asked = true;
    api.preview(file, optionsOf(choices, latest.current?.file === file ? latest.current : null)).then((p) => asked && setPreview(p), (e) => asked && tell(e));
    return () => {
      asked = false;
    };
  }, [file, choices, tell]);
  useEffect(() => {
    setWanted(null);
    if (dataset) api.read(dataset).then((text) => setWanted(JSON.parse(text)), () => setWanted(null));
  }, [dataset]);
  if (!preview || preview.file !== file) return <div className="panel-body" />;
  const options = optionsOf(choices, preview);
  const isOpen = preview.questions.length > 0 || preview.columns.length === 0;
  const missing = wanted ? missingColumns(wanted, preview) : [];
  const guarded = async (action: () => Promise<void>) => {
    setBusy(true);
    try {
      await action();
    } catch (error) {
      tell(error);
    }
    setBusy(false);
  };
  const start = () => guarded(async () => {
    const made = await api.startFrom(files, options, folder);
    await refresh();
    await open(made.diagram);
    set({dropped: [], data: made.dataset, tab: 'data'});
    say(`wrote ${made.diagram} and ${made.dataset}`);
  });
  const join = () => guarded(async () => {
    await api.join(file, options, dataset, role);
    await refresh();
    const rest = files.filter((f) => f !== file);
    set({dropped: rest, data: dataset});
    say(`${labelOf(file)} is in ${dataset}: it ${role === 'train' ? 'trains' : role === 'validate' ? 'validates' : 'tests'}`);
  });
  return (
    <>
      <div className="panel-head">
        {files.length > 1 ? <select aria-label="dropped recording" value={file} onChange={(e) => setShown(e.target.value)}>{files.map((f) => <option key={f} value={f}>{labelOf(f)}</option>)}</select> : <b>{labelOf(file)}</b>}
        <span className="headline muted">{preview.rows ? `${preview.rows} rows, ${withUnit(preview.from!, '')} … ${withUnit(preview.to!, preview.time_unit!)}` : preview.raw_rows ? `${preview.raw_rows} rows` : ''}</span>
        <label className="muted">folder <input className="field short" aria-label="folder" value={folder} onChange={(e) => setFolder(e.target.value)} spellCheck={false} /></label>
        <button className="primary" disabled={isOpen || busy} title={isOpen ? 'answer what is open first' : `hysteron new --from ${files.map(labelOf).join(' ')} -o ${folder}`} onClick={() => void start()}>New diagram{files.length > 1 ? ` from ${files.length}` : ''}</button>
        {dataset && (
          <>
            <select aria-label="role in the data set" value={role} onChange={(e) => setRole(e.target.value)}><option value="train">trains</option><option value="validate">validates</option><option value="test">tests</option></select>
            <button disabled={isOpen || busy || missing.length > 0} title={missing.length ? `${dataset} reads columns that are not here: ${missing.join(', ')}` : `beside ${dataset}, and into it`} onClick={() => void join()}>Add to {labelOf(dataset)}</button>
          </>
        )}
        <button className="quiet" aria-label="discard the recording" title="look at it no longer" onClick={() => set({dropped: files.filter((f) => f !== file)})}>×</button>
      </div>
      <div className="data">
        <div className="scroll"><Columns preview={preview} choices={choices} onChoices={setChoices} /></div>
        <div className="scroll asked">
          {preview.questions.length > 0 && <h3>to answer</h3>}
          {preview.questions.map((q, i) => <Question key={`${q.code}${i}`} problem={q} preview={preview} choices={choices} onChoices={setChoices} />)}
          {preview.assumed.length > 0 && <h3>assumed</h3>}
          <ul className="assumed">{preview.assumed.map((a, i) => <li key={i}>{a}</li>)}</ul>
          {preview.assumed.length === 0 && preview.questions.length === 0 && <p className="empty">The file says all that is needed.</p>}
        </div>
      </div>
    </>
  );
}

interface Listed {
  file: string;
  role?: string;
  skip?: string;
  until?: string;
  remark?: string;
}

/// The recordings of the data set that is chosen, and what each is for.
function DataSet({path}: {path: string}) {
  const tell = useStudio((s) => s.tell);
  const [read, setRead] = useState<{text: string; hash: string} | null>(null);
  const load = useCallback(() => api.view(path, 0).then((v) => setRead({text: v.text, hash: v.hash}), tell), [path, tell]);
  useEffect(() => {
    setRead(null);
    void load();
  }, [load]);
  const document = useMemo(() => {
    try {
      return read && JSON.parse(read.text);
    } catch {
      return null;
    }
  }, [read]);
  const recordings: Listed[] = document?.recordings ?? [];
  const setRole = async (i: number, role: string) => {
    const at = pointer('recordings', i);
    try {
      await api.edit(path, [recordings[i].role === undefined ? {kind: 'insert', pointer: at, key: 'role', value: jsonText(role)} : {kind: 'replace', pointer: at + pointer('role'), value: jsonText(role)}], read!.hash, 0);
    } catch (error) {
      if (!(error instanceof Conflict)) tell(error);
    }
    await load();
  };
  if (!document) return <div className="panel-body" />;
  return (
    <div className="data">
      <div className="scroll">
        <table className="columns">
          <thead><tr><th>recording</th><th>role</th><th>from</th><th>until</th><th>remark</th></tr></thead>
          <tbody>
            {recordings.map((r, i) => (
              <tr key={i}>
                <td>{r.file}</td>
                <td><select aria-label={`role of ${r.file}`} value={r.role ?? 'train'} onChange={(e) => void setRole(i, e.target.value)}><option value="train">trains</option><option value="validate">validates</option><option value="test">tests</option></select></td>
                <td>{r.skip ?? ''}</td><td>{r.until ?? ''}</td><td className="muted">{r.remark ?? ''}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <div className="scroll asked">
        <h3>columns</h3>
        <ul className="assumed">{Object.entries<any>(document.columns ?? {}).map(([name, c]) => <li key={name}>{name} → {c?.to ?? name}{c?.unit ? ` [${c.unit}]` : ''}{c?.between_samples ? `, ${c.between_samples} between samples` : ''}</li>)}</ul>
      </div>
    </div>
  );
}

export function Data() {
  const dropped = useStudio((s) => s.dropped);
  const data = useStudio((s) => s.data);
  const kind = useStudio((s) => s.files.find((f) => f.path === s.data)?.kind);
  const chooser = useRef<HTMLInputElement>(null);
  if (dropped.length) return <Preview key={dropped.join('\n')} files={dropped} />;
  return (
    <>
      <div className="panel-head">
        <span className="headline">{data ? <>{kind === 'recording' ? `${data}: the first 60 % of its time train, the rest validates` : data}</> : 'No data are chosen.'}</span>
        <input ref={chooser} type="file" multiple hidden aria-label="recordings" onChange={(e) => { void takeIn([...(e.target.files ?? [])]); e.target.value = ''; }} />
        <button onClick={() => chooser.current?.click()}>Open a recording</button>
      </div>
      {kind === 'dataset' ? <DataSet key={data} path={data} /> : (
        <div className="start"><p>Drop a recording anywhere on this page: CSV, LVM, XLSX, MAT, HDF5, TDMS. It is looked at before anything is written.</p></div>
      )}
    </>
  );
}
