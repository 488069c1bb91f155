// Decides how the symbol of a block is drawn on the page: what draw/svg.cpp does for files, from the same numbers.

import {memo} from 'react';
import type {Item, Pictogram, Point, Sheet} from '../types';
import {choiceText, sumNameOffset} from './extent';
import {arrowHead, ownWays, roundedPath} from './paths';

const pictogramWidth = 48;
const pictogramHeight = 30;

function Outline({item}: {item: Item}) {
  const {width: w, height: h, symbol} = item;
  const stacked = (item.choice?.candidates ?? 0) > 1;
  switch (symbol.outline) {
    case 'circle':
      return <circle className="box" cx={w / 2} cy={h / 2} r={w / 2} />;
    case 'triangle':
      return (
        <>
          {stacked && <polygon className="shadow" points={`4,-4 ${4 + w},${h / 2 - 4} 4,${h - 4}`} />}
          <polygon className="box" points={`0,0 ${w},${h / 2} 0,${h}`} />
        </>
      );
    case 'port':
      return <rect className="port" width={w} height={h} rx={h / 2} />;
    case 'frame':
      return (
        <>
          {stacked && <rect className="shadow" x={4} y={-4} width={w} height={h} rx={4} />}
          <rect className="frame" width={w} height={h} rx={4} />
          {!item.inside && <rect className="axis" x={3} y={3} width={w - 6} height={h - 6} rx={2} />}
        </>
      );
    case 'box':
      return (
        <>
          {stacked && <rect className="shadow" x={4} y={-4} width={w} height={h} rx={4} />}
          <rect className="box" width={w} height={h} rx={4} />
        </>
      );
  }
}

function Picture({item, picture}: {item: Item; picture: Pictogram}) {
  const cx = item.width / 2;
  const cy = item.height / 2 - (item.symbol.note ? 6 : 0);
  const at = ([x, y]: Point): Point => [cx + (pictogramWidth / 2) * x, cy - (pictogramHeight / 2) * y];
  const line = (a: Point, b: Point, key: string) => {
    const [p, q] = [at(a), at(b)];
    return <line key={key} className="axis" x1={p[0]} y1={p[1]} x2={q[0]} y2={q[1]} />;
  };
  return (
    <g>
      {picture.axes && [line([-1.1, 0], [1.1, 0], 'x'), line([0, -1.1], [0, 1.1], 'y')]}
      {picture.time && [line([-1, 0], [1.1, 0], 'x'), line([-1, -1.1], [-1, 1.1], 'y')]}
      {picture.curves.map((curve, i) => (
        <polyline key={i} className="curve" points={curve.map((p) => at(p).map((v) => v.toFixed(1)).join(',')).join(' ')} />
      ))}
      {picture.arrows.map(({way, size}, i) => (
        <polygon key={i} className="mark" points={arrowHead(at(way[0]), at(way[way.length - 1]), 6 * size)} />
      ))}
    </g>
  );
}

function Texts({item}: {item: Item}) {
  const s = item.symbol;
  const middle = item.height / 2;
  const centre = s.outline === 'triangle' ? 0.36 * item.width : item.width / 2;
  const css = s.outline === 'triangle' || s.outline === 'port' ? 'value' : 'formula';
  if (s.fraction) {
    const wide = Math.max(...s.text.map((t) => t.length)) * 6.6 + 4;
    return (
      <g>
        <text className={css} x={centre} y={middle - 6}>{s.text[0]}</text>
        <text className={css} x={centre} y={middle + 15}>{s.text[1]}</text>
        <line className="bar" x1={centre - wide / 2} x2={centre + wide / 2} y1={middle} y2={middle} />
      </g>
    );
  }
  const first = middle + 4 - 7.5 * (s.text.length - 1);
  return (
    <g>
      {s.text.map((t, i) => <text key={i} className={css} x={centre} y={first + 15 * i}>{t}</text>)}
      {s.note && <text className="small" x={item.width / 2} y={item.height - 4}>{s.note}</text>}
    </g>
  );
}

function Signs({item}: {item: Item}) {
  return (
    <g>
      {item.in.map((port, i) => {
        const sign = item.symbol.signs[i] === '-' ? '−' : '+';
        if (item.symbol.outline !== 'circle') return <text key={i} className="formula" x={port.x + 9} y={port.y + 4}>{sign}</text>;
        const at = port.side === 'left' ? [port.x - 7, port.y - 6] : [port.x + 8, port.side === 'top' ? port.y - 4 : port.y + 12];
        return <text key={i} className="sign" x={at[0]} y={at[1]}>{sign}</text>;
      })}
    </g>
  );
}

function PortNames({item}: {item: Item}) {
  const alike = new Set(item.in.map((p) => p.name)).size <= 1;
  return (
    <g>
      {!alike && item.in.map((p, i) => <text key={`i${i}`} className="small start" x={5} y={p.y + 3}>{p.name}</text>)}
      {item.out.length > 1 && item.out.map((p, i) => <text key={`o${i}`} className="small end" x={item.width - 5} y={p.y + 3}>{p.name}</text>)}
    </g>
  );
}

/// The name, which candidate is in use, and values, below the symbol; of an open diagram above its blocks.
function Caption({item, chosen}: {item: Item; chosen: string}) {
  const lines = [...(chosen ? [chosen] : []), ...item.caption];
  if (item.inside)
    return (
      <text className="name start" x={8} y={16}>
        {item.name} <tspan className="line">{lines.join(', ')}</tspan>
      </text>
    );
  const beside = item.symbol.outline === 'circle';
  const y = item.height + 13;
  return (
    <g>
      <text className={beside ? 'name start' : 'name'} x={beside ? item.width / 2 + sumNameOffset : item.width / 2} y={y}>{item.name}</text>
      {lines.map((t, i) => <text key={i} className="line" x={item.width / 2} y={y + 1 + 12 * (i + 1)}>{t}</text>)}
    </g>
  );
}

/// The name of an open diagram that is seen from afar, as large as its frame allows.
function PlainName({item}: {item: Item}) {
  const size = Math.min(item.height / 3, item.width / (0.7 * item.name.length));
  return <text className="plain" x={item.width / 2} y={item.height / 2 + size / 3} style={{fontSize: size}}>{item.name}</text>;
}

interface Props {
  item: Item;
  pictures: Record<string, Pictogram>;
  plain?: boolean;
  bare?: boolean;  // in the palette: no name, no caption
}

export const SymbolView = memo(function SymbolView({item, pictures, plain, bare}: Props) {
  if (plain) return item.inside ? <><Outline item={item} /><PlainName item={item} /></> : <Outline item={item} />;
  const picture = pictures[item.symbol.picture];
  return (
    <>
      <Outline item={item} />
      {item.inside ? (
        <g transform="translate(0,22)"><SheetView sheet={item.inside} pictures={pictures} /></g>
      ) : (
        <>
          {picture && <Picture item={item} picture={picture} />}
          <Texts item={item} />
          {item.symbol.signs && <Signs item={item} />}
          {item.symbol.port_names && !item.symbol.signs && <PortNames item={item} />}
        </>
      )}
      {!bare && item.symbol.outline !== 'port' && <Caption item={item} chosen={choiceText(item)} />}
      {!bare && item.out.map((port, i) => port.unit && <text key={i} className="unit start" x={port.x + ((item.choice?.candidates ?? 0) > 1 ? 9 : 5)} y={port.y - 5}>{port.unit}</text>)}
    </>
  );
});

/// A whole sheet as it stands in an open diagram: to be looked at, not edited.
export function SheetView({sheet, pictures}: {sheet: Sheet; pictures: Record<string, Pictogram>}) {
  const ways = ownWays(sheet.wires);
  return (
    <g>
      {sheet.items.map((item, i) => {
        const y = item.y + item.height / 2;
        if (item.type === 'input') return <line key={i} className="bar" x1={0} x2={item.x} y1={y} y2={y} />;
        if (item.type === 'output') return <line key={i} className="bar" x1={item.x + item.width} x2={sheet.width} y1={y} y2={y} />;
        return null;
      })}
      {sheet.wires.map((wire, i) => (
        <g key={i} className={wire.length > 1 ? 'wire vector' : 'wire'}>
          <path d={roundedPath(ways[i])} />
          <polygon points={arrowHead(wire.path[wire.path.length - 2], wire.path[wire.path.length - 1], 7)} />
        </g>
      ))}
      {sheet.dots.map(([x, y], i) => <circle key={i} className="branch" cx={x} cy={y} r={2.6} />)}
      {sheet.items.map((item, i) => (
        <g key={i} transform={`translate(${item.x},${item.y})`}><SymbolView item={item} pictures={pictures} /></g>
      ))}
    </g>
  );
}
