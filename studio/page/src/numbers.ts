// Decides how numbers are told: four digits where nobody asks for more, never without their unit.

export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  return String(Number(value.toPrecision(digits)));
}

export const withUnit = (value: number, unit: string, digits = 4) => (unit ? `${short(value, digits)} ${unit}` : short(value, digits));

/// The unit of 1/time, where times are in `unit`.
export const frequencyUnit = (unit: string) => (unit === 's' ? 'Hz' : unit && `1/${unit}`);

/// How far something is: nobody reads tenths of it.
export const wholePercent = (share: number) => `${Math.floor(100 * share)} %`;

/// A sentence of the program, as a page shows it: what a terminal writes as "->" is an arrow.
export const sentence = (text: string) => text.replace(/ -> /g, ' → ');

export const percent = (share: number) => (share > 0 && share < 1e-4 ? '< 0.01 %' : `${short(100 * share, 3)} %`);

const prefixes: [number, string][] = [[1e-9, 'n'], [1e-6, 'u'], [1e-3, 'm'], [1, '']];

/// Lengths in the unit that gives few digits: 0.000234 um is 0.234 nm. Other units are left as they are.
export function lengthText(value: number, unit: string): string {
  const found = /^(n|u|m)m$/.exec(unit);
  if (!found || value === 0) return withUnit(value, unit);
  const metres = value * prefixes.find(([, p]) => p === found[1])![0];
  const best = [...prefixes].reverse().find(([scale]) => Math.abs(metres) >= 0.1 * scale) ?? prefixes[0];
  return `${short(metres / best[0])} ${best[1]}m`;
}

export function duration(seconds: number): string {
  if (seconds < 0) return '';
  if (seconds < 60) return `${Math.ceil(seconds)} s`;
  return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
}

export function clock(milliseconds: number): string {
  return new Date(milliseconds).toLocaleTimeString([], {hour: '2-digit', minute: '2-digit', second: '2-digit', hour12: false});
}
