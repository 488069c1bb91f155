import {describe, expect, it} from 'vitest';
import type {RecordingPreview} from '../types';
import {controlsFor, folderFor, missingColumns, noChoices, optionsOf, roleOf} from './recording';

const column = (name: string) => ({name, unit: '', smallest: 0, largest: 1, low: [], high: []});
const preview: RecordingPreview = {
  file: 'lab.csv', raw: [], raw_rows: 3, as_it_stands: true, assumed: [], questions: [], inputs: ['u'], outputs: ['y'],
  columns: ['t', 'u', 'y', 'T'].map(column),
};
const problem = (code: string, path = '', cure = '') => ({code, path, what: '', cure});

describe('what a recording is read as', () => {
  it('asks for nothing where the user said nothing', () => expect(optionsOf(noChoices, preview)).toEqual({}));
  it('writes answers as options of the verb new', () => {
    expect(optionsOf({...noChoices, time: 'Zeit', units: {Weg: 'mm', Kraft: ' '}, decimal: 'comma'}, null))
      .toEqual({'--time': 'Zeit', '--decimal': 'comma', '--unit': ['Weg=mm']});
  });
  it('gives all roles once one was changed', () => {
    expect(roleOf('T', preview, noChoices)).toBe('other');
    expect(optionsOf({...noChoices, roles: {T: 'output'}}, preview)).toEqual({'--input': ['u'], '--output': ['y', 'T']});
    expect(optionsOf({...noChoices, roles: {T: 'without'}}, preview)).toEqual({'--without': ['T']});
  });
  it('knows what answers a question', () => {
    expect(controlsFor(problem('ambiguous_decimal'))).toEqual(['decimal']);
    expect(controlsFor(problem('missing_column', 't'))).toEqual(['time', 'interval']);
    expect(controlsFor(problem('missing_column', 'force'))).toEqual([]);
    expect(controlsFor(problem('something', '', 'say which: --sheet NAME'))).toEqual(['sheet']);
  });
  it('names a folder, and columns that a data set wants', () => {
    expect(folderFor('.hysteron/dropped/Lab Monday (2).csv')).toBe('lab_monday_2');
    expect(folderFor('###.csv')).toBe('recording');
    expect(missingColumns({columns: {u: {}, F: {}, T2: {optional: true}}}, preview)).toEqual(['F']);
  });
});
