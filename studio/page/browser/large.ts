// Decides what large diagrams the pictures and figures are made with: a machine of many axes, nested and flat. Plain text,
// made by rule, so that it is the same each time.

/// A servo axis of ten blocks, from the wanted position to the position.
export const axis = `{
  "format": 1,
  "title": "Servo axis",
  "inputs": {"wanted": {"unit": "mm"}, "load": {"unit": "N"}},
  "blocks": {
    "error":    {"type": "sum", "signs": "+-", "in": ["wanted", "table.position"]},
    "kv":       {"type": "gain", "gain": "50 1/s", "in": "error"},
    "lead":     {"type": "filtered_derivative", "time": "1 ms", "in": "wanted"},
    "speed":    {"type": "sum", "in": ["kv", "lead"]},
    "deviation": {"type": "sum", "signs": "+-", "in": ["speed", "table.velocity"]},
    "control":  {"type": "gain", "gain": "2 N s/mm", "in": "deviation"},
    "limit":    {"type": "saturation", "lower": "-500 N", "upper": "500 N", "in": "control"},
    "drive":    {"type": "lag", "times": ["1 ms"], "in": "limit"},
    "force":    {"type": "sum", "signs": "+-", "in": ["drive", "load"]},
    "table":    {"type": "mass_spring_damper", "mass": "20 kg", "damping": "100 N s/m", "stiffness": "0 N/m", "in": "force"}
  },
  "outputs": {"position": "table.position", "error": "error"}
}
`;

/// So many axes, each a nested diagram of ten blocks, that follow one another: 20 of them are 200 blocks.
export function nested(axes: number): string {
  const blocks = ['    "move": {"type": "sine", "amplitude": "20 mm", "frequency": "2 Hz"}', '    "load": {"type": "pulse", "low": "-30 N", "high": "30 N", "period": "0.3 s"}'];
  for (let i = 1; i <= axes; ++i) blocks.push(`    "axis_${i}": {"type": "diagram", "file": "axis.json", "in": ["${i % 5 === 1 ? 'move' : `axis_${i - 1}.position`}", "load"]}`);
  const last = Array.from({length: axes}, (_, i) => i + 1).filter((i) => i % 5 === 0 || i === axes);  // nothing reads these
  const record = ['move', 'axis_1.position', 'axis_1.error', ...last.map((i) => `axis_${i}.position`)];
  return `{
  "format": 1,
  "title": "Machine of ${axes} axes",
  "blocks": {
${blocks.join(',\n')}
  },
  "record": ${JSON.stringify(record).replaceAll(',', ', ')},
  "simulate": {"until": "1 s", "every": "1 ms"}
}
`;
}

/// The same axes without nesting: ten blocks each, in one diagram.
export function flat(axes: number): string {
  const one = JSON.parse(axis);
  const lines = ['    "move": {"type": "sine", "amplitude": "20 mm", "frequency": "2 Hz"}', '    "load": {"type": "pulse", "low": "-30 N", "high": "30 N", "period": "0.3 s"}'];
  for (let i = 1; i <= axes; ++i) {
    const named = (signal: string) => (signal === 'wanted' ? (i % 5 === 1 ? 'move' : `table_${i - 1}.position`) : signal === 'load' ? 'load' : signal.replace(/^[a-z]+/, (name) => `${name}_${i}`));
    for (const [name, block] of Object.entries<any>(one.blocks)) {
      const inputs = typeof block.in === 'string' ? named(block.in) : block.in.map(named);
      lines.push(`    "${name}_${i}": ${JSON.stringify({...block, in: inputs})}`);
    }
  }
  return `{
  "format": 1,
  "title": "${10 * axes} blocks in one diagram",
  "blocks": {
${lines.join(',\n')}
  },
  "record": ["move", "table_1.position", "table_${axes}.position"],
  "simulate": {"until": "0.2 s", "every": "1 ms"}
}
`;
}
