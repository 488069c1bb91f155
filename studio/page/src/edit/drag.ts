// Decides what a drag does to a number: how much a pixel is, and how the number is written. Plain functions.

/// "3.2 um/V" in its parts; null for what is no single number.
export function numberParts(text: string): {value: number; unit: string} | null {
  const parts = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?:\s+([a-zA-Z%°µ1(][^+]*?))?\s*$/.exec(text);
  return parts ? {value: Number(parts[1]), unit: parts[2] ?? ''} : null;
}

const digits = 4;  // of a number that was dragged: finer is no hand

/// One pixel is a hundredth of the number's power of ten; ten times finer with Shift.
export function stepOf(value: number, fine: boolean): number {
  const size = value === 0 ? 1 : 10 ** Math.floor(Math.log10(Math.abs(value)));
  return (size / 100) * (fine ? 0.1 : 1);
}

/// The number so many steps further, as it is written; a number that must not pass zero stops one step before it.
export function dragged(text: string, steps: number, fine: boolean, keepsSign: boolean): string {
  const parts = numberParts(text);
  if (!parts) return text;
  const step = stepOf(parts.value, fine);
  let value = parts.value + steps * step;
  if (keepsSign && parts.value !== 0 && value * parts.value <= 0) value = Math.sign(parts.value) * step;
  const places = Math.max(digits, Math.ceil(Math.log10(Math.max(Math.abs(value) / step, 1))) + 1);
  const written = String(Number(value.toPrecision(Math.min(places, 15))));
  return parts.unit ? `${written} ${parts.unit}` : written;
}
