// What the server says (studio/view.h, sheet_json.h, jobs.h, trace_file.h), as types.

export type Point = [number, number];

export interface Problem {
  code: string;
  path: string;
  what: string;
  cure: string;
  file?: string;
  line?: number;
}

export interface Symbol {
  outline: 'box' | 'circle' | 'triangle' | 'port' | 'frame';
  picture: string;
  text: string[];
  fraction: boolean;
  note: string;
  signs: string;
  port_names: boolean;
}

export interface InPort {
  name: string;
  x: number;
  y: number;
  side: 'left' | 'top' | 'bottom';
  reads: string;
}

export interface OutPort {
  name: string;
  x: number;
  y: number;
  unit: string;
  length: number;
}

export interface Item {
  path: string;
  name: string;
  type: string;
  x: number;
  y: number;
  width: number;
  height: number;
  symbol: Symbol;
  in: InPort[];
  out: OutPort[];
  caption: string[];
  tip: string;
  choice?: {chosen: string; candidates: number};
  inside?: Sheet;
}

export interface Wire {
  from: number;
  out: number;
  to: number;
  in: number;
  signal: string;
  feedback: boolean;
  length: number;
  path: Point[];
}

export interface Sheet {
  width: number;
  height: number;
  items: Item[];
  wires: Wire[];
  dots: Point[];
}

export interface View {
  text: string;
  hash: string;
  problems: Problem[];
  warnings: Problem[];
  sheet: Sheet | null;
  places: Record<string, Point>;  // of blocks that were moved by hand, in steps of the grid
}

/// Where blocks go; null: back to where the layout puts them.
export type Moves = Record<string, Point | null>;

export interface ListedFile {
  path: string;
  kind: 'diagram' | 'dataset' | 'recording' | 'job';
  title: string;
}

export interface PortDeclaration {
  name: string;
  unit: string;
  meaning: string;
  any_number: boolean;
  vector: boolean;
}

export interface ParameterDeclaration {
  name: string;
  unit: string;
  meaning: string;
  kind: 'number' | 'list' | 'text' | 'matrix';
  default: string | null;
  choices: string[];
  minimum: number | null;
  exclusive_minimum: boolean;
  maximum: number | null;
  linear: boolean;
}

export interface BlockDeclaration {
  type: string;
  summary: string;
  group: string;
  law: string;
  source: string;
  remarks: string[];
  inputs: PortDeclaration[];
  outputs: PortDeclaration[];
  parameters: ParameterDeclaration[];
}

export interface Pictogram {
  axes: boolean;
  time: boolean;
  curves: Point[][];
  arrows: {way: Point[]; size: number}[];
}

export interface Library {
  blocks: BlockDeclaration[];
  symbols: Record<string, Item>;
  laws: Record<string, string>;  // as MathML
  pictures: Record<string, Pictogram>;
}

export type JobState = 'waiting' | 'running' | 'done' | 'failed' | 'cancelled' | 'lost';

export interface JobOrder {
  verb: string;
  diagram: string;
  options?: Options;
}

export interface Job {
  id: string;
  verb: string;
  diagram: string;
  data: string;
  words: string[];
  asked: JobOrder;
  folder: string;
  state: JobState;
  fraction: number;
  what: string;
  seconds_left: number;
  headline: string;
  exit_code: number;
  problems: Problem[];
  began: number;
  stale: boolean;
}

export interface TraceHead {
  rows: number;
  from: number | null;
  to: number | null;
  columns: {name: string; unit: string}[];
}

export interface Span {
  recording: string;
  seconds: Point[];
}

export interface SplitPart {
  label: string;
  share_of_rows: number;
  share_of_squared_error: number;
  spans: Span[];
}

export interface Split {
  by: string;
  output: string;
  sentence?: string;
  parts: SplitPart[];
}

export interface Metric {
  output: string;
  recording: string;
  role: string;
  rms: number;
  nrmse: number;
  rows: number;
  unit: string;
}

export interface Found {
  parameter: string;
  value: number;
  start: number;
  unit: string;
  low95: number | null;
  high95: number | null;
  determined: boolean;
  at_bound: boolean;
  usual: string;
}

export interface Errors {
  rms_train: number;
  rms_validate: number;
  nrmse_train: number;
  nrmse_validate: number;
  unit: string;
}

export interface Candidate {
  effect: string;
  law: string;
  place: string;
  claimed: boolean;
  failed: boolean;
  reason: string;
  summary: string;
  step: number;
  share_removed: number;
  error: Errors;
  found: Found[];
  same_effects: string[];
}

export interface DiscoveryStep {
  step: number;
  effect: string;
  place: string;
  block: string;
  sentence: string;
  before: Errors;
  after: Errors;
  evidence: Candidate;
  ties: {effect: string; place: string}[];
  experiment_would_tell: boolean;
}

export interface Result {
  verb: string;
  headline: string;
  verdict: string;
  sentences: string[];
  warnings: string[];
  traces: string[];
  files: string[];
  facts: {
    traces?: Record<string, Record<string, {last: number; smallest: number; largest: number; unit: string}>>;
    metrics?: Metric[];
    splits?: Split[];
    splits_before?: Split[];
    steps?: DiscoveryStep[];
    candidates?: Candidate[];
    refused?: {effect: string; place: string; reason: string}[];
    as_given?: Errors;
    base?: Errors;
    final?: Errors;
    floor?: {output: string; noise_rms: number; unit: string}[];
    inspection?: {cannot_show: {effect: string; reason: string}[]};
  };
}

export type Edit =
  | {kind: 'replace'; pointer: string; value: string}
  | {kind: 'insert'; pointer: string; key?: string; value: string; after?: string}
  | {kind: 'remove'; pointer: string}
  | {kind: 'rename'; pointer: string; key: string};

/// A recording that was dropped on the page, as far as it can be read (studio/import.h).
export interface RecordingPreview {
  file: string;
  raw: {name: string; unit: string; values: (number | null)[]}[];
  raw_rows: number;
  columns: {name: string; unit: string; smallest: number; largest: number; low: (number | null)[]; high: (number | null)[]}[];
  rows?: number;
  from?: number;
  to?: number;
  time_unit?: string;
  as_it_stands: boolean;
  assumed: string[];
  inputs: string[];
  outputs: string[];
  questions: Problem[];
}

/// Options of a verb as the page asks for them: {"--data": "lab.csv", "--set": ["a=1"]}
export type Options = Record<string, string | string[] | boolean>;
