// Decides what the canvas shows: the sheet as the server laid it out, what is selected, highlighted and wrong on it.

import {
  Background, BackgroundVariant, ControlButton, Controls, Handle, MiniMap, Position, ReactFlow, ReactFlowProvider, useReactFlow, useStore, useStoreApi,
  getViewportForBounds, ViewportPortal, type Connection, type Edge, type EdgeChange, type EdgeProps, type Node, type NodeChange, type NodeProps, applyNodeChanges,
} from '@xyflow/react';
import {memo, useCallback, useEffect, useMemo, useRef, useState} from 'react';
import {api} from '../data/api';
import {currentPath, useStudio} from '../data/store';
import type {Item, Point, Problem, Sheet} from '../types';
import {grid, looseWire, movesOf} from './moving';
import {extent} from './extent';
import {same, withKept} from './kept';
import {arrowHead, ownWays, roundedPath} from './paths';
import {SymbolView} from './SymbolView';
import * as actions from '../edit/actions';

const sides = {left: Position.Left, top: Position.Top, bottom: Position.Bottom} as const;
const plainBelow = 0.35;  // zoom: symbols are no longer read
const largestFit = 1.25;
const buttonsHeight = 38;  // [px]

/// That a block is there for an effect, and which candidate is taken when it is switched.
interface EffectSwitch {
  effect: string;
  isOn: boolean;
  other: string;
}
type BlockData = {item: Item; problem: string; highlighted: boolean; fits: (string | null)[] | null; isNew: boolean; effect: EffectSwitch | null};
type BlockNode = Node<BlockData, 'block'>;
type WireData = {path: Point[]; own: Point[]; vector: boolean; tip: string};
type WireEdge = Edge<WireData, 'wire'>;

const Block = memo(function Block({data, selected}: NodeProps<BlockNode>) {
  const {item, problem, highlighted, fits, isNew, effect} = data;
  const plain = useStore((s) => s.transform[2] < plainBelow);
  const pictures = useStudio((s) => s.catalogue?.pictures) ?? {};
  const css = ['block', selected && 'selected', problem && 'wrong', highlighted && 'highlighted', isNew && 'new'].filter(Boolean).join(' ');
  return (
    <div className={css} title={problem || item.tip}>
      <svg width={item.width} height={item.height} className="symbol">
        <SymbolView item={item} pictures={pictures} plain={plain} />
        {problem && <circle className="alarm" cx={item.width} cy={0} r={5} />}
      </svg>
      {effect && !plain && (
        <button className={`effect-switch nodrag ${effect.isOn ? 'on' : ''}`} role="switch" aria-checked={effect.isOn} tabIndex={-1} aria-label={`effect of ${item.name}`}
                title={`effect: ${effect.effect}, ${effect.isOn ? 'on' : 'off'}; a click switches it`} onClick={(e) => { e.stopPropagation(); void actions.choose(item.name, effect.other); }} />
      )}
      {item.in.map((port, i) => (
        <Handle key={`i${i}`} id={`i${i}`} type="target" position={sides[port.side]} title={fits?.[i] || port.name}
                className={`port-in ${port.side} ${port.reads ? 'wired' : 'free'} ${fits ? (fits[i] === '' ? 'fits' : 'misfit') : ''}`}
                style={{left: port.x, top: port.y}} />
      ))}
      {item.out.map((port, i) => (
        <Handle key={`o${i}`} id={`o${i}`} type="source" position={Position.Right} title={port.unit ? `${port.name} [${port.unit}]` : port.name}
                className="port-out" style={{left: port.x, top: port.y}} />
      ))}
    </div>
  );
});

const WireLine = memo(function WireLine({data, selected}: EdgeProps<WireEdge>) {
  if (!data) return null;
  const {path, own} = data;
  const d = roundedPath(path);
  return (
    <g className={`wire ${data.vector ? 'vector' : ''} ${selected ? 'selected' : ''}`}>
      <title>{data.tip}</title>
      <path className="touch react-flow__edge-interaction" d={d} />
      <path d={roundedPath(own)} />
      <path className="whole" d={d} />
      <polygon points={arrowHead(path[path.length - 2], path[path.length - 1], 8)} />
    </g>
  );
});

const nodeTypes = {block: Block};
const edgeTypes = {wire: WireLine};
const steps: [number, number] = [grid, grid];
const panButtons = [1, 2];

/// What is wrong at each block, by the JSON pointers and block paths of the problems.
export function problemsByBlock(problems: Problem[]): Map<string, string> {
  const found = new Map<string, string>();
  for (const p of problems) {
    const name = (/^\/(?:blocks|outputs|inputs)\/([^/]+)/.exec(p.path) ?? /^([a-zA-Z][a-zA-Z0-9_]*)/.exec(p.path))?.[1];
    if (name) found.set(name, [found.get(name), p.what].filter(Boolean).join('\n'));
  }
  return found;
}

/// Blocks that stand for an effect and can be switched: those of two candidates, one of them "off".
export function effectsOf(document: any): Map<string, EffectSwitch> {
  const found = new Map<string, EffectSwitch>();
  for (const [name, block] of Object.entries<any>(document?.blocks ?? {})) {
    const candidates = Object.keys(block?.from ?? {});
    const other = candidates.find((c) => c !== block.choose);
    if (block?.effect && candidates.length === 2 && candidates.includes('off') && other) found.set(name, {effect: String(block.effect), isOn: block.choose !== 'off', other});
  }
  return found;
}

interface Wanting {
  node: string;
  out: number;
  fits: Map<string, string> | null;
}

function nodesOf(sheet: Sheet, problems: Map<string, string>, highlighted: string[], fresh: string[], wanting: Wanting | null, effects: Map<string, EffectSwitch>): BlockNode[] {
  return sheet.items.map((item, index) => ({
    id: item.path,
    type: 'block' as const,
    position: {x: item.x, y: item.y},
    width: item.width,
    height: item.height,
    ariaLabel: `${item.name}, ${item.type}`,
    data: {
      item,
      problem: problems.get(item.name) ?? '',
      highlighted: highlighted.includes(item.name),
      isNew: fresh.includes(item.name),
      effect: effects.get(item.name) ?? null,
      fits: wanting?.fits ? item.in.map((_, i) => wanting.fits!.get(`${index}/${i}`) ?? null) : null,
    },
  }));
}

/// A block whose ports stay where they were need not be measured again.
const measuredAgain = (before: BlockNode, now: BlockNode): BlockNode => {
  const {item: a} = before.data, {item: b} = now.data;
  return before.measured && same([a.width, a.height, a.in, a.out], [b.width, b.height, b.in, b.out]) ? {...now, measured: before.measured} : now;
};

function edgesOf(sheet: Sheet, last: Map<string, string>): WireEdge[] {
  const own = ownWays(sheet.wires);
  return sheet.wires.map((w, index) => {
    const from = sheet.items[w.from];
    const to = sheet.items[w.to];
    return {
      id: `${w.signal}>${to.path}/${w.in}`,
      type: 'wire' as const,
      source: from.path,
      target: to.path,
      sourceHandle: `o${w.out}`,
      targetHandle: `i${w.in}`,
      ariaLabel: `wire from ${w.signal} to ${to.name}`,
      data: {
        path: w.path,
        own: own[index],
        vector: w.length > 1,
        tip: `${w.signal}${from.out[w.out].unit ? ` [${from.out[w.out].unit}]` : ''}${last.get(w.signal) ?? ''}`,
      },
    };
  });
}

/// Wires of blocks that are being carried, simply drawn.
function withLooseWires(edges: WireEdge[], sheet: Sheet, carried: Record<string, {x: number; y: number}>): WireEdge[] {
  return edges.map((edge, i) => {
    const wire = sheet.wires[i];
    const [from, to] = [sheet.items[wire.from], sheet.items[wire.to]];
    if (!carried[from.path] && !carried[to.path]) return edge;
    const [a, b] = [carried[from.path] ?? from, carried[to.path] ?? to];
    const [out, into] = [from.out[wire.out], to.in[wire.in]];
    const path = looseWire([a.x + out.x, a.y + out.y], [b.x + into.x, b.y + into.y]);
    return {...edge, data: {...edge.data!, path, own: path}};
  });
}

function Flow() {
  const view = useStudio((s) => s.trial?.view ?? s.view);
  const trial = useStudio((s) => s.trial);
  const path = useStudio(currentPath);
  const highlighted = useStudio((s) => s.highlighted);
  const selected = useStudio((s) => s.selected);
  const result = useStudio((s) => s.results[s.shownJob]);
  const flow = useReactFlow();
  const pane = useStoreApi();
  const whole = useRef('');  // the view that shows all of it
  const [nodes, setNodes] = useState<BlockNode[]>([]);
  const [wanting, setWanting] = useState<Wanting | null>(null);
  const fitted = useRef('');
  const [carried, setCarried] = useState<Record<string, {x: number; y: number}>>({});
  const dragging = useRef(false);
  const byKeys = useRef<{places: Record<string, {x: number; y: number}>; timer: number}>({places: {}, timer: 0});
  const sheet = view?.sheet ?? null;
  const depth = useStudio((s) => s.depth);
  // What the answers to gestures read. They stay the same functions: each that is another one is told to all that is drawn.
  const latest = useRef({sheet, path, wanting});
  latest.current = {sheet, path, wanting};
  const moved = useMemo(() => Object.keys(view?.places ?? {}), [view?.places]);

  const problems = useMemo(() => problemsByBlock(view?.problems ?? []), [view?.problems]);
  const document = useStudio((s) => s.document);
  const effects = useMemo(() => effectsOf(trial ? null : document), [trial, document]);
  const fresh = useMemo(() => (trial ? trial.fresh : []), [trial]);
  const last = useMemo(() => {
    const found = new Map<string, string>();
    for (const trace of Object.values(result?.facts.traces ?? {}))
      for (const [name, s] of Object.entries(trace)) found.set(name, `, last ${Number(s.last.toPrecision(4))} ${s.unit}`);
    return found;
  }, [result]);

  useEffect(() => {
    setNodes((now) => (sheet ? withKept(now, nodesOf(sheet, problems, highlighted, fresh, wanting, effects), measuredAgain) : []));
  }, [sheet, problems, highlighted, fresh, wanting, effects]);

  /// All of it in view, with what is written beside the blocks, above the buttons at the lower border.
  const fit = useCallback(() => {
    const {width, height} = pane.getState();
    if (!sheet || !width || !height) return;
    const seen = getViewportForBounds(extent(sheet), width, height - buttonsHeight, 0.05, largestFit, 0.06);
    whole.current = `${seen.x},${seen.y},${seen.zoom}`;
    void flow.setViewport(seen);
  }, [sheet, pane, flow]);

  // As long as nobody has moved the view, all of it stays in view when the canvas becomes larger or smaller.
  const size = useStore((s) => `${s.width}x${s.height}`);
  useEffect(() => {
    if (pane.getState().transform.join() === whole.current) fit();
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [size]);

  useEffect(() => {
    // Where nested diagrams are opened in place, the sheet becomes another one as well.
    const key = `${path}${trial ? trial.file : ''}${sheet?.items.some((i) => i.inside) ? ' opened' : ''}`;
    if (!sheet || fitted.current === key) return;
    fitted.current = key;
    requestAnimationFrame(fit);
  }, [sheet, path, trial, fit]);

  const drawnEdges = useRef<WireEdge[]>([]);
  const edges = useMemo(() => (drawnEdges.current = sheet ? withKept(drawnEdges.current, edgesOf(sheet, last)) : []), [sheet, last]);
  const looseEdges = useMemo(() => (sheet && Object.keys(carried).length ? withLooseWires(edges, sheet, carried) : edges), [edges, sheet, carried]);
  const selectedWire = useStudio((s) => s.selectedWire);
  // What is carried is drawn where it is carried, whatever the server tells of the sheet meanwhile.
  const shownNodes = useMemo(() => nodes.map((n) => {
    const held = carried[n.id] && {position: carried[n.id], dragging: true};
    return held || selected.includes(n.id) ? {...n, ...held, selected: selected.includes(n.id)} : n;
  }), [nodes, selected, carried]);
  const shownEdges = useMemo(() => looseEdges.map((e) => (e.id === selectedWire ? {...e, selected: true} : e)), [looseEdges, selectedWire]);

  // What is selected stands in the store; nodes and edges are drawn from there, so that nothing is told in circles.
  const onNodesChange = useCallback((changes: NodeChange<BlockNode>[]) => {
    const {selected: before, set} = useStudio.getState();
    const after = new Set(before);
    for (const c of changes) if (c.type === 'select') c.selected ? after.add(c.id) : after.delete(c.id);
    if (after.size !== before.length || before.some((id) => !after.has(id))) set({selected: [...after]});
    const others = changes.filter((c) => c.type !== 'select' && c.type !== 'position');
    if (others.length) setNodes((now) => applyNodeChanges(others, now));
    // Arrow keys move what is selected: one gesture until they rest.
    const keyed = byKeys.current;
    for (const c of changes) if (c.type === 'position' && c.position && !dragging.current) keyed.places[c.id] = c.position;
    if (!Object.keys(keyed.places).length || dragging.current) return;
    setCarried({...keyed.places});
    clearTimeout(keyed.timer);
    keyed.timer = window.setTimeout(() => {
      const {places} = keyed;
      keyed.places = {};
      void put(places);
    }, 400);
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, []);

  /// Blocks are put where they were carried: beside the file, and wires find their ways.
  const put = useCallback(async (places: Record<string, {x: number; y: number}>) => {
    const named = Object.fromEntries(Object.entries(places).flatMap(([id, p]) => {
      const item = latest.current.sheet?.items.find((i) => i.path === id);
      return item && (Math.abs(item.x - p.x) >= 1 || Math.abs(item.y - p.y) >= 1) ? [[item.name, p]] : [];
    }));
    if (Object.keys(named).length > 0) await useStudio.getState().move(movesOf(named));
    if (!dragging.current) setCarried({...byKeys.current.places});  // the next gesture may have begun
  }, []);

  // Before the first place is told: what is dragged is not moved by keys as well.
  const onDragStart = useCallback(() => {
    dragging.current = true;
  }, []);
  const onDrag = useCallback((_: unknown, __: unknown, all: BlockNode[]) => setCarried(Object.fromEntries(all.map((n) => [n.id, n.position]))), []);
  const onDragStop = useCallback((_: unknown, __: unknown, all: BlockNode[]) => {
    dragging.current = false;
    void put(Object.fromEntries(all.map((n) => [n.id, n.position])));
  }, [put]);

  const onManyDragged = useCallback((e: unknown, all: BlockNode[]) => onDrag(e, null, all), [onDrag]);
  const onManyPut = useCallback((e: unknown, all: BlockNode[]) => onDragStop(e, null, all), [onDragStop]);

  const onEdgesChange = useCallback((changes: EdgeChange<WireEdge>[]) => {
    for (const c of changes) {
      if (c.type !== 'select') continue;
      const {selectedWire: now, set} = useStudio.getState();
      if (c.selected) set({selectedWire: c.id});
      else if (now === c.id) set({selectedWire: ''});
    }
  }, []);

  const onConnectStart = useCallback(async (_: unknown, from: {nodeId: string | null; handleId: string | null; handleType: string | null}) => {
    const {sheet, path} = latest.current;
    if (!sheet || from.handleType !== 'source') return;
    const item = sheet.items.find((i) => i.path === from.nodeId);
    const out = Number(from.handleId?.slice(1) ?? 0);
    if (!item) return;
    const start = {node: item.path, out, fits: null};
    setWanting(start);
    try {
      const list = await api.fits(path, actions.signalOf(item, out));
      setWanting((now) => (now?.node === start.node ? {...start, fits: new Map(list.map((f) => [`${f.item}/${f.in}`, f.why]))} : now));
    } catch {
      // the file cannot be read at the moment: every port stays as it is
    }
  }, []);

  const onConnect = useCallback((c: Connection) => {
    const {sheet, wanting} = latest.current;
    if (!sheet) return;
    const from = sheet.items.find((i) => i.path === c.source);
    const index = sheet.items.findIndex((i) => i.path === c.target);
    if (!from || index < 0) return;
    const to = Number(c.targetHandle?.slice(1) ?? 0);
    const why = wanting?.fits?.get(`${index}/${to}`);
    if (why) useStudio.getState().say(why, 'error');
    else void actions.connect(from, Number(c.sourceHandle?.slice(1) ?? 0), sheet.items[index], to);
  }, []);
  const onConnectEnd = useCallback(() => setWanting(null), []);

  const open = useCallback((_: unknown, node: BlockNode) => {
    const {item} = node.data;
    if (item.type === 'diagram') void actions.openNested(item);
  }, []);

  if (!view) return null;
  return (
    <ReactFlow<BlockNode, WireEdge>
      nodes={shownNodes} edges={shownEdges} nodeTypes={nodeTypes} edgeTypes={edgeTypes}
      onNodesChange={onNodesChange}
      onEdgesChange={onEdgesChange}
      onNodeDoubleClick={open}
      onConnectStart={onConnectStart} onConnect={onConnect} onConnectEnd={onConnectEnd}
      onNodeDragStart={onDragStart} onNodeDrag={onDrag} onNodeDragStop={onDragStop}
      onSelectionDragStart={onDragStart} onSelectionDrag={onManyDragged} onSelectionDragStop={onManyPut}
      nodesDraggable={!trial && depth === 0} snapToGrid snapGrid={steps} nodeDragThreshold={3} nodesConnectable={!trial} elementsSelectable
      onlyRenderVisibleElements minZoom={0.05} maxZoom={4}
      selectionOnDrag panOnDrag={panButtons} panOnScroll zoomOnDoubleClick={false}
      deleteKeyCode={null} proOptions={{hideAttribution: true}} connectionRadius={24}
      onDragOver={(e) => e.preventDefault()}
      onDrop={(e) => {
        const type = e.dataTransfer.getData('application/hysteron-block');
        if (type) void actions.place(type, false, flow.screenToFlowPosition({x: e.clientX, y: e.clientY}));
      }}
    >
      <Background variant={BackgroundVariant.Dots} gap={16} size={1} className="grid" />
      <ViewportPortal>
        <svg className="dots">
          {sheet?.dots.map(([x, y], i) => <circle key={i} className="branch" cx={x} cy={y} r={2.6} />)}
        </svg>
      </ViewportPortal>
      <Controls showInteractive={false} showFitView={false} position="bottom-left" orientation="horizontal">
        <ControlButton title="see all of it" aria-label="see all of it" className="fit-all" onClick={fit}>
          <svg viewBox="0 0 16 16" aria-hidden><path d="M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4" fill="none" stroke="currentColor" strokeWidth="1.6" /></svg>
        </ControlButton>
        {moved.length > 0 && !trial && (
          <ControlButton title="lay everything out anew: blocks that were moved by hand go back" aria-label="lay out anew" onClick={() => void useStudio.getState().move(Object.fromEntries(moved.map((name) => [name, null])))}>
            <svg viewBox="0 0 16 16" aria-hidden><path d="M1 3h5v4H1zM10 1h5v4h-5zM10 11h5v4h-5zM6 5h2M8 3v10M8 3h2M8 13h2" fill="none" stroke="currentColor" /></svg>
          </ControlButton>
        )}
      </Controls>
      {(sheet?.items.length ?? 0) > 30 && <MiniMap pannable zoomable position="bottom-right" nodeStrokeWidth={2} />}
    </ReactFlow>
  );
}

export function Canvas() {
  return (
    <ReactFlowProvider>
      <Flow />
    </ReactFlowProvider>
  );
}
