// Decides what the answers to the questions about a recording are as options of "hysteron new". Plain functions.

import type {Options, Problem, RecordingPreview} from '../types';

export type Role = 'input' | 'output' | 'other' | 'without';

/// What the user said of a file; empty where he left it to the guess.
export interface Choices {
  time: string;
  interval: string;
  decimal: string;
  names: string;
  sheet: string;
  group: string;
  units: Record<string, string>;
  roles: Record<string, Role>;
}

export const noChoices: Choices = {time: '', interval: '', decimal: '', names: '', sheet: '', group: '', units: {}, roles: {}};

/// The role of a column: as the user says, else as it was guessed.
export function roleOf(column: string, preview: RecordingPreview, choices: Choices): Role {
  return choices.roles[column] ?? (preview.inputs.includes(column) ? 'input' : preview.outputs.includes(column) ? 'output' : 'other');
}

/// Roles are given for all columns once one of them is: a guess beside them would be another one.
export function optionsOf(choices: Choices, preview: RecordingPreview | null): Options {
  const options: Options = {};
  for (const name of ['time', 'interval', 'decimal', 'names', 'sheet', 'group'] as const)
    if (choices[name].trim()) options[`--${name}`] = choices[name].trim();
  const units = Object.entries(choices.units).filter(([, unit]) => unit.trim());
  if (units.length) options['--unit'] = units.map(([column, unit]) => `${column}=${unit.trim()}`);
  const left = Object.entries(choices.roles).filter(([, role]) => role === 'without').map(([column]) => column);
  if (left.length) options['--without'] = left;
  const given = Object.values(choices.roles).some((role) => role !== 'without');
  if (given && preview) {
    const columns = preview.columns.map((c) => c.name).filter((name) => name !== 't');
    for (const role of ['input', 'output'] as const) {
      const list = columns.filter((name) => roleOf(name, preview, choices) === role);
      if (list.length) options[`--${role}`] = list;
    }
  }
  return options;
}

export type Control = 'time' | 'interval' | 'decimal' | 'names' | 'sheet' | 'group' | 'unit' | 'without' | 'roles';

/// What answers a question.
export function controlsFor(problem: Problem): Control[] {
  const table: Record<string, Control[]> = {
    ambiguous_time: ['time', 'interval'], no_time: ['time', 'interval'], ambiguous_decimal: ['decimal'], no_header: ['names'],
    bad_unit: ['unit', 'without'], ambiguous_unit: ['unit', 'without'], wrong_unit: ['unit', 'time'], sparse_column: ['without'], unclear_columns: ['roles'],
    ambiguous_sheet: ['sheet'], no_sheet: ['sheet'], ambiguous_group: ['group'], ambiguous_table: ['group'],
  };
  if (problem.code === 'missing_column') return problem.path === 't' ? ['time', 'interval'] : [];
  if (table[problem.code]) return table[problem.code];
  // The verb names the option that answers.
  return (['time', 'interval', 'decimal', 'names', 'sheet', 'group', 'without'] as const).filter((name) => problem.cure.includes(`--${name}`));
}

/// A folder for what is made of a recording: its name without the ending, in letters that need no quotes.
export const folderFor = (file: string) =>
  (file.split('/').pop() ?? '').replace(/\.[^.]*$/, '').toLowerCase().replace(/[^a-z0-9]+/g, '_').replace(/^_+|_+$/g, '') || 'recording';

/// Columns that a data set binds and that the recording does not have.
export function missingColumns(dataset: any, preview: RecordingPreview): string[] {
  const there = new Set(preview.columns.map((c) => c.name));
  return Object.entries<any>(dataset?.columns ?? {}).filter(([name, column]) => !there.has(name) && !column?.optional).map(([name]) => name);
}
