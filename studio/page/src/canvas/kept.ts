// Decides which nodes and wires of a sheet are the same as before: these stay the very objects, and are not drawn again.
// Plain functions.

/// Do two values hold the same? Objects and lists are looked into.
export function same(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  if (Array.isArray(a) || Array.isArray(b)) return Array.isArray(a) && Array.isArray(b) && a.length === b.length && a.every((one, i) => same(one, b[i]));
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => key in b && same((a as any)[key], (b as any)[key]));
}

/// `now`, with those of `before` that hold the same; `before` itself where all do. What only `before` has (as what was
/// measured of a node) tells no difference; `renewed` makes the one that is drawn of two that differ.
export function withKept<T extends {id: string}>(before: T[], now: T[], renewed: (before: T, now: T) => T = (_, n) => n): T[] {
  const old = new Map(before.map((one) => [one.id, one]));
  const all = now.map((one) => {
    const was = old.get(one.id);
    if (!was) return one;
    return (Object.keys(one) as (keyof T)[]).every((key) => same(was[key], one[key])) ? was : renewed(was, one);
  });
  return all.length === before.length && all.every((one, i) => one === before[i]) ? before : all;
}
