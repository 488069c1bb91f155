// Decides what is told of what is selected: values with units and bounds, ports, the law and its source; and of the
// diagram where nothing is.

import {useEffect, useRef, useState} from 'react';
import {api} from '../data/api';
import {follow, giveUp, letGo} from '../data/live';
import {useStudio} from '../data/store';
import * as actions from '../edit/actions';
import {shownValue, signalName} from '../edit/document';
import {dragged, numberParts} from '../edit/drag';
import {withUnit} from '../numbers';
import type {BlockDeclaration, Item, ParameterDeclaration} from '../types';

/// A text that is written when it is left or Enter is pressed, and stays as it was on Escape. The arrows up and down
/// move a number, and the curves follow where `live` says which number of the diagram it is.
export function Field({value, placeholder, label, onCommit, wrong, live}: {value: string; placeholder?: string; label: string; wrong?: boolean; live?: string; onCommit: (text: string) => unknown}) {
  const [text, setText] = useState(value);
  const moved = useRef(false);
  const typing = useRef(false);  // the answer to an edit before does not take away what is being typed, by letters or arrows
  useEffect(() => {
    if (!typing.current) setText(value);
  }, [value]);
  const type = (next: string) => {
    typing.current = true;
    setText(next);
  };
  const commit = () => {
    typing.current = false;
    if (moved.current) {
      moved.current = false;
      return void letGo(async () => text !== value && (await onCommit(text)));
    }
    if (text !== value) void onCommit(text);
  };
  const forget = () => {
    typing.current = false;
    setText(value);
    if (moved.current) giveUp();
    moved.current = false;
  };
  return (
    <input className={wrong ? 'field wrong' : 'field'} value={text} placeholder={placeholder} aria-label={label} spellCheck={false}
           onChange={(e) => type(e.target.value)} onBlur={commit}
           onKeyDown={(e) => {
             const way = e.key === 'ArrowUp' ? 1 : e.key === 'ArrowDown' ? -1 : 0;
             if (e.key === 'Enter') e.currentTarget.blur();  // which commits; the keys are the canvas's again
             if (e.key === 'Escape') forget();
             if (live && way && numberParts(text)) {
               e.preventDefault();
               moved.current = true;
               const next = dragged(text, way, e.shiftKey, true);
               type(next);
               void follow(`${live}=${next}`, `${live} = ${next}`);
             }
             if (!(e.ctrlKey && e.key === 'Enter')) e.stopPropagation();
           }} />
  );
}

/// The name of a number, by which it is dragged: the curves follow, and it is written when it is let go.
export function Handle({name, meaning, value, live, onMove, onCommit}: {name: string; meaning?: string; value: string; live: string; onMove: (text: string) => void; onCommit: (text: string) => unknown}) {
  if (!numberParts(value)) return <label title={meaning}>{name}</label>;
  const down = (e: React.PointerEvent<HTMLLabelElement>) => {
    if (e.button !== 0) return;
    e.preventDefault();
    const target = e.currentTarget;
    const start = e.clientX;
    let text = value;
    target.setPointerCapture(e.pointerId);
    const move = (m: PointerEvent) => {
      const next = dragged(value, Math.round(m.clientX - start), m.shiftKey, true);
      if (next === text) return;
      text = next;
      onMove(text);
      void follow(`${live}=${text}`, `${live} = ${text}`);
    };
    const stop = (ended: Event) => {
      target.removeEventListener('pointermove', move);
      for (const kind of ['pointerup', 'pointercancel']) target.removeEventListener(kind, stop);
      onMove('');
      if (text === value || ended.type === 'pointercancel') return giveUp();
      void letGo(async () => onCommit(text));
    };
    target.addEventListener('pointermove', move);
    for (const kind of ['pointerup', 'pointercancel']) target.addEventListener(kind, stop);
  };
  return (
    <label className="handle" title={`${meaning ? `${meaning}\n` : ''}drag to the left and right: the curves follow (Shift: finer)`} onPointerDown={down}>
      {name}
    </label>
  );
}

function bounds(p: ParameterDeclaration): string {
  const low = p.minimum === null ? '' : `${p.exclusive_minimum ? '>' : '≥'} ${p.minimum}`;
  const high = p.maximum === null ? '' : `≤ ${p.maximum}`;
  return [low, high].filter(Boolean).join(', ');
}

/// The same number in other units, one click each.
function OtherUnits({value, onPick}: {value: string; onPick: (text: string) => void}) {
  const [units, setUnits] = useState<{text: string}[] | null>(null);
  useEffect(() => setUnits(null), [value]);
  if (!/^[-+.\d].*[a-zA-Z%]/.test(value)) return null;
  if (!units) return <button className="quiet small" title="the same in other units" onClick={async () => setUnits(await api.units(value))}>units</button>;
  return (
    <div className="units">
      {units.length === 0 && <span className="muted">no other unit</span>}
      {units.map((u) => <button key={u.text} className="chip" onClick={() => onPick(u.text)}>{u.text}</button>)}
    </div>
  );
}

/// What a number is where the block itself does not say it: as the file of parameters has it.
function fromFile(item: Item, name: string): string {
  return item.tip.split('\n').find((line) => line.startsWith(`${name} `))?.slice(name.length + 1) ?? '';
}

function Parameter({block, p, value, problem, elsewhere}: {block: string; p: ParameterDeclaration; value: unknown; problem: string; elsewhere: string}) {
  const shown = shownValue(value);
  const unit = p.unit && !p.unit.includes('$') ? p.unit : '';
  const commit = (text: string) => actions.setValue(block, p.name, text);
  const live = `${block}.${p.name}`;
  const [now, setNow] = useState('');
  return (
    <div className="row">
      <Handle name={p.name} meaning={p.meaning} value={p.kind === 'number' ? shown : ''} live={live} onMove={setNow} onCommit={commit} />
      {p.kind === 'text' && p.choices.length > 0 ? (
        <select className="field" aria-label={p.name} value={shown || p.default || p.choices[0]} onChange={(e) => void commit(e.target.value)}>
          {p.choices.map((c) => <option key={c}>{c}</option>)}
        </select>
      ) : (
        <Field label={p.name} value={now || shown} wrong={problem !== ''} live={p.kind === 'number' ? live : undefined}
               placeholder={elsewhere ? `${elsewhere} (from file)` : p.default !== null ? `${p.default || 'none'} (default)` : unit ? `in ${unit}` : ''} onCommit={commit} />
      )}
      <div className="about">
        {problem ? <span className="problem">{problem}</span> : <span>{p.meaning}{bounds(p) && <span className="bounds">, {bounds(p)}</span>}</span>}
        <OtherUnits value={shown} onPick={commit} />
      </div>
    </div>
  );
}

function Ports({item, declaration}: {item: Item; declaration?: BlockDeclaration}) {
  const items = useStudio((s) => (s.trial?.view ?? s.view)?.sheet?.items) ?? [];
  const signals = items.flatMap((i) => i.out.map((_, k) => signalName(i, k)));
  return (
    <section>
      <h3>ports</h3>
      <table className="ports">
        <tbody>
          {item.in.map((p, i) => (
            <tr key={`i${i}`} title={declaration?.inputs.find((d) => d.name === p.name)?.meaning}>
              <td className="muted">in</td><td>{p.name}</td>
              <td>
                <select className={p.reads ? 'wire' : 'wire open'} aria-label={`wire of ${p.name}`} value={p.reads} onChange={(e) => void (e.target.value ? actions.connectSignal(e.target.value, item, i) : actions.disconnect(item, i))}>
                  <option value="">not wired</option>
                  {[...new Set([...signals, ...(p.reads ? [p.reads] : [])])].map((s) => <option key={s}>{s}</option>)}
                </select>
              </td>
            </tr>
          ))}
          {item.out.map((p, i) => (
            <tr key={`o${i}`} title={declaration?.outputs.find((d) => d.name === p.name)?.meaning}>
              <td className="muted">out</td><td>{p.name}</td><td>{p.unit || <span className="muted">plain number</span>}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Recorded({signal}: {signal: string}) {
  const document = useStudio((s) => s.document);
  const result = useStudio((s) => s.results[s.shownJob]);
  const last = Object.values(result?.facts.traces ?? {}).map((t) => t[signal]).find(Boolean);
  const list: string[] = document?.record ?? [];
  return (
    <div className="row check">
      <label><input type="checkbox" aria-label={`record ${signal}`} checked={list.includes(signal)} onChange={(e) => void actions.record(signal, e.target.checked)} /> record {signal}</label>
      {last && <div className="about">last {withUnit(last.last, last.unit)}, between {withUnit(last.smallest, last.unit)} and {withUnit(last.largest, last.unit)}</div>}
    </div>
  );
}

function BlockPanel({item}: {item: Item}) {
  const catalogue = useStudio((s) => s.catalogue);
  const document = useStudio((s) => s.document);
  const problems = useStudio((s) => s.view?.problems ?? []);
  const block = document?.blocks?.[item.name];
  const body = actions.bodyOf(block);
  const declaration = catalogue?.blocks.find((b) => b.type === item.type);
  const declared = declaration?.parameters ?? [];
  const known = new Set(['type', 'in', 'choose', 'from', 'effect', 'upon', ...declared.map((p) => p.name)]);
  const others = Object.keys(body ?? {}).filter((k) => !known.has(k));
  const ofBlock = problems.filter((p) => p.path.startsWith(`/blocks/${item.name}/`) || p.path === `/blocks/${item.name}`);
  const ofParameter = (name: string) => ofBlock.find((p) => p.path.endsWith(`/${name}`))?.what ?? '';
  return (
    <>
      <header>
        <Field label="name of the block" value={item.name} onCommit={(text) => void actions.rename(item.name, text.trim())} />
        <div className="about"><strong>{item.type}</strong>{declaration && ` – ${declaration.summary}`}</div>
      </header>
      {ofBlock.filter((p) => !declared.some((d) => p.path.endsWith(`/${d.name}`))).map((p, i) => <p key={i} className="problem">{p.what}<br /><span className="muted">{p.cure}</span></p>)}
      {block?.from && (
        <section>
          <h3>{block.effect ? `effect: ${block.effect}` : 'choice'}</h3>
          <div className="segments" role="radiogroup">
            {Object.keys(block.from).map((name) => (
              <button key={name} role="radio" aria-checked={name === block.choose} className={name === block.choose ? 'on' : ''} onClick={() => void actions.choose(item.name, name)}>{name}</button>
            ))}
          </div>
          {Object.keys(block.from).length > 1 && <button className="compare-all" title="run the diagram with each of them, and lay the curves over each other" onClick={() => void actions.compareCandidates(item.name)}>Compare all {Object.keys(block.from).length}</button>}
        </section>
      )}
      {(declared.length > 0 || others.length > 0) && (
        <section>
          <h3>values</h3>
          {declared.map((p) => <Parameter key={p.name} block={item.name} p={p} value={body?.[p.name]} problem={ofParameter(p.name)}
                                             elsewhere={typeof body?.parameters === 'string' && body[p.name] === undefined ? fromFile(item, p.name) : ''} />)}
          {others.map((k) => (
            <div className="row" key={k}><label>{k}</label><Field label={k} value={shownValue(body[k])} wrong={ofParameter(k) !== ''} onCommit={(text) => void actions.setValue(item.name, k, text)} />
              {ofParameter(k) && <div className="about problem">{ofParameter(k)}</div>}</div>
          ))}
        </section>
      )}
      <Ports item={item} declaration={declaration} />
      <section>{item.out.map((_, i) => <Recorded key={i} signal={signalName(item, i)} />)}</section>
      {declaration && (
        <section className="law">
          <h3>law</h3>
          {declaration.law && <p className="formula" title={declaration.law} dangerouslySetInnerHTML={{__html: catalogue?.laws[declaration.type] ?? ''}} />}
          {declaration.remarks.map((r, i) => <p key={i}>{r}</p>)}
          {declaration.source && <p className="muted">{declaration.source}</p>}
        </section>
      )}
      {item.type === 'diagram' && <button onClick={() => void actions.openNested(item)}>Open {String(body?.file ?? 'diagram')}</button>}
    </>
  );
}

/// A parameter of the diagram: a number that is dragged, its bounds below it.
function DiagramParameter({name, value}: {name: string; value: any}) {
  const [now, setNow] = useState('');
  const shown = shownValue(value);
  const commit = (text: string) => actions.setIn('parameters', name, text);
  return (
    <div className="row">
      <Handle name={name} meaning={value?.remark} value={shown} live={name} onMove={setNow} onCommit={commit} />
      <Field label={name} value={now || shown} live={name} onCommit={commit} />
      {value?.bounds && <div className="about">{value.free ? 'free, ' : ''}between {value.bounds.map(shownValue).join(' and ')}</div>}
    </div>
  );
}

function Section({title, section, hint}: {title: string; section: string; hint: string}) {
  const document = useStudio((s) => s.document);
  const members = Object.entries<any>(document?.[section] ?? {});
  return (
    <section>
      <h3>{title}</h3>
      {members.length === 0 && <p className="empty">{hint}</p>}
      {members.map(([key, value]) => section === 'parameters' ? <DiagramParameter key={key} name={key} value={value} /> : (
        <div className="row" key={key}>
          <label title={value?.remark}>{key}</label>
          <Field label={key} value={section === 'inputs' ? value?.unit ?? '' : shownValue(value)}
                 onCommit={(text) => (section === 'inputs' ? actions.setInput(key, text) : actions.setIn(section, key, text))} />
        </div>
      ))}
    </section>
  );
}

function DiagramPanel() {
  const document = useStudio((s) => s.document);
  const view = useStudio((s) => s.view);
  const n = Object.keys(document?.blocks ?? {}).length;
  return (
    <>
      <header>
        <Field label="title" value={document?.title ?? ''} placeholder="title" onCommit={(text) => void actions.setTitle(text)} />
        <div className="about">{n} {n === 1 ? 'block' : 'blocks'}{document?.source ? `; ${document.source}` : ''}</div>
      </header>
      <section>
        <h3>simulate</h3>
        {['until', 'every'].map((key) => (
          <div className="row" key={key}>
            <label>{key}</label>
            <Field label={key} value={shownValue(document?.simulate?.[key])} placeholder={key === 'until' ? 'e.g. 1 s' : 'e.g. 1 ms'} onCommit={(text) => void actions.setIn('simulate', key, text)} />
          </div>
        ))}
      </section>
      <Section title="parameters" section="parameters" hint="Numbers that several blocks share stand here; a block reads one as $name." />
      <Section title="inputs" section="inputs" hint="Inputs are bound by name to the columns of a recording." />
      <Section title="outputs" section="outputs" hint="Outputs are what a recording measures: name and signal." />
      {(view?.problems.length ?? 0) > 0 && <p className="problem">{view!.problems.length} to cure: see the tab Problems.</p>}
    </>
  );
}

export function Inspector() {
  const selected = useStudio((s) => s.selected);
  const wire = useStudio((s) => s.selectedWire);
  const view = useStudio((s) => s.trial?.view ?? s.view);
  const item = view?.sheet?.items.find((i) => i.path === selected[0]);
  const signal = wire.split('>')[0];
  let content = <DiagramPanel />;
  if (selected.length > 1) content = <header><strong>{selected.length} blocks</strong><div className="about">Delete removes them, Ctrl+C copies them as JSON.</div></header>;
  else if (item && (item.type === 'input' || item.type === 'output')) content = <><header><strong>{item.name}</strong><div className="about">{item.type} of the diagram</div></header><Ports item={item} /></>;
  else if (item) content = <BlockPanel key={item.path} item={item} />;
  else if (signal) content = <><header><strong>{signal}</strong><div className="about">signal</div></header><Recorded signal={signal} /><button onClick={() => void actions.removeSelected()}>Remove this wire</button></>;
  return <aside className="inspector" aria-label="Inspector">{content}</aside>;
}
