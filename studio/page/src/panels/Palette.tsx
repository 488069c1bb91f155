// Decides what the palette shows: block types by group, found by names, summaries and what Simulink calls them.

import {useMemo, useState} from 'react';
import {useStudio} from '../data/store';
import {place} from '../edit/actions';
import {found} from '../edit/search';
import {SymbolView} from '../canvas/SymbolView';
import type {BlockDeclaration, Item, Pictogram} from '../types';

export function Icon({item, pictures}: {item: Item; pictures: Record<string, Pictogram>}) {
  const {width: w, height: h} = item;
  return (
    <svg className="icon symbol" viewBox={`-4 -6 ${w + 8} ${h + 12}`} width={36} height={24} preserveAspectRatio="xMidYMid meet">
      <SymbolView item={item} pictures={pictures} bare />
    </svg>
  );
}

function Entry({block}: {block: BlockDeclaration}) {
  const catalogue = useStudio((s) => s.catalogue)!;
  return (
    <li>
      <button className="entry" draggable title={`${block.summary}\n${block.law}`}
              onDragStart={(e) => e.dataTransfer.setData('application/hysteron-block', block.type)}
              onDoubleClick={() => void place(block.type)}
              onKeyDown={(e) => e.key === 'Enter' && void place(block.type)}>
        <Icon item={catalogue.symbols[block.type]} pictures={catalogue.pictures} />
        <span className="label">{block.type}</span>
      </button>
    </li>
  );
}

export function Palette() {
  const catalogue = useStudio((s) => s.catalogue);
  const [words, setWords] = useState('');
  const blocks = useMemo(() => found(catalogue?.blocks ?? [], words), [catalogue, words]);
  const groups = useMemo(() => [...new Set(blocks.map((b) => b.group))], [blocks]);
  return (
    <div className="palette">
      <input className="search" type="search" placeholder="Search blocks" aria-label="Search blocks" value={words} onChange={(e) => setWords(e.target.value)} />
      <div className="scroll">
        {groups.map((group) => (
          <section key={group}>
            <h3>{group}</h3>
            <ul>{blocks.filter((b) => b.group === group).map((b) => <Entry key={b.type} block={b} />)}</ul>
          </section>
        ))}
        {blocks.length === 0 && <p className="empty">No block is called so.</p>}
      </div>
      <p className="hint">Drag a block onto the canvas, or press <kbd>/</kbd> there.</p>
    </div>
  );
}
