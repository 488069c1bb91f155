// Decides how the signals beside the curves are listed: which are shown, and their values at the mouse, or at two cursors
// with what lies between.

import {useStudio} from '../data/store';
import {frequencyUnit, short} from '../numbers';
import type {TraceHead} from '../types';
import {Field} from './Inspector';
import type {AtCursors} from './cursors';

interface Props {
  head: TraceHead;
  off: Set<string>;
  onOff: (off: Set<string>) => void;
  colourOf: (name: string, index: number) => string;
  at: {at: number | null; values: Record<string, number>};
  cursors: AtCursors | null;
  children?: React.ReactNode;
}

const told = (value: number | undefined, digits = 5) => (value === undefined ? '' : short(value, digits));

/// What lies between the cursors: the difference of the times and its inverse, which is a frequency.
function Between({cursors, unit}: {cursors: AtCursors; unit: string}) {
  const [a, b] = [cursors.first?.at, cursors.second?.at];
  if (a === undefined || b === undefined || a === b) return null;
  return <li className="between">1/(B − A) <span className="now">{short(1 / Math.abs(b - a), 5)} <span className="muted">{frequencyUnit(unit)}</span></span></li>;
}

export function Signals({head, off, onOff, colourOf, at, cursors, children}: Props) {
  const names = head.columns.slice(1).map((c) => c.name);
  const time = head.columns[0];
  const cursorField = (label: string, value: number | undefined, put: (at: number) => void) => {
    const commit = (text: string) => {
      const typed = text.trim();
      const number = time.unit && typed.endsWith(time.unit) ? typed.slice(0, -time.unit.length).trim() : typed;
      if (number !== '' && Number.isFinite(Number(number))) return put(Number(number));
      useStudio.getState().say(`"${typed}" is no place for cursor ${label}: give a number${time.unit && ` in ${time.unit}`} with a decimal point, as 0.05`, 'error');
    };
    return <span className="cell"><Field label={`cursor ${label}`} value={value === undefined ? '' : short(value, 7)} onCommit={commit} /></span>;
  };
  return (
    <ul className={cursors ? 'signals wide' : 'signals'} aria-label="signals">
      {cursors && <li className="cells"><span className="label muted">{time.name} [{time.unit}]</span>{cursorField('A', cursors.first?.at, cursors.putFirst)}{cursorField('B', cursors.second?.at, cursors.putSecond)}
        <span className="cell">{cursors.first && cursors.second && short(cursors.second.at - cursors.first.at, 6)}</span></li>}
      {cursors && <li className="cells muted"><span className="label" /><span className="cell">A</span><span className="cell">B</span><span className="cell">B − A</span></li>}
      {names.map((name, i) => {
        const [a, b] = [cursors?.first?.values[name], cursors?.second?.values[name]];
        return (
          <li key={name}>
            <label title={name}>
              <input type="checkbox" checked={!off.has(name)} onChange={() => onOff(new Set(off.has(name) ? [...off].filter((n) => n !== name) : [...off, name]))} />
              <span className="swatch" style={{background: `var(${colourOf(name, i)})`}} />
              <span className="label">{name}{cursors && head.columns[i + 1].unit && <span className="muted"> [{head.columns[i + 1].unit}]</span>}</span>
              {cursors ? <><span className="cell">{told(a)}</span><span className="cell">{told(b)}</span><span className="cell">{a !== undefined && b !== undefined && short(b - a, 5)}</span></>
                       : <span className="now">{at.values[name] !== undefined && short(at.values[name])} <span className="muted">{head.columns[i + 1].unit}</span></span>}
            </label>
          </li>
        );
      })}
      {cursors ? <Between cursors={cursors} unit={time.unit} />
               : <li className="time"><span className="label">{time.name}</span><span className="now">{at.at !== null && short(at.at, 6)} <span className="muted">{time.unit}</span></span></li>}
      {children}
    </ul>
  );
}
