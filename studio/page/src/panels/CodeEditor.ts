// Decides how the text of a diagram is edited: CodeMirror with our completion, problems at their lines. Loaded when the
// text is opened first. It lies in a shadow root, where its styles need no leave from the page's content policy.

import {autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, type Completion, type CompletionContext} from '@codemirror/autocomplete';
import {defaultKeymap, history, historyKeymap, indentWithTab} from '@codemirror/commands';
import {json} from '@codemirror/lang-json';
import {bracketMatching, defaultHighlightStyle, foldGutter, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting, syntaxTree} from '@codemirror/language';
import {lintGutter, setDiagnostics, type Diagnostic} from '@codemirror/lint';
import {EditorState} from '@codemirror/state';
import {drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers} from '@codemirror/view';
import {highlightSelectionMatches, searchKeymap} from '@codemirror/search';
import {tags} from '@lezer/highlight';
import type {SyntaxNode} from '@lezer/common';
import {offersAt, type Place} from '../edit/completion';
import type {BlockDeclaration, Problem} from '../types';

export interface Editor {
  text(): string;
  setText(text: string): void;
  tell(problems: Problem[]): void;
  goTo(line: number): void;
  destroy(): void;
}

interface Wishes {
  onChange(): void;
  onSave(): void;
  known(): {document: any; blocks: BlockDeclaration[]};
}

const look = EditorView.theme({
  '&': {height: '100%', fontSize: '13px', color: 'var(--text)', backgroundColor: 'var(--panel)'},
  '&.cm-focused': {outline: 'none'},
  '.cm-scroller': {fontFamily: "ui-monospace, 'DejaVu Sans Mono', monospace", lineHeight: '20px'},
  '.cm-content': {caretColor: 'var(--text)'},
  '.cm-cursor': {borderLeftColor: 'var(--text)'},
  '.cm-gutters': {backgroundColor: 'var(--panel)', color: 'var(--muted)', borderRight: '1px solid var(--line)'},
  '.cm-activeLine, .cm-activeLineGutter': {backgroundColor: 'var(--hover)'},
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': {backgroundColor: 'var(--accent-soft)'},
  '.cm-tooltip': {backgroundColor: 'var(--panel)', color: 'var(--text)', border: '1px solid var(--line-strong)', borderRadius: '4px'},
  '.cm-tooltip-autocomplete ul li[aria-selected]': {backgroundColor: 'var(--accent-soft)', color: 'var(--text)'},
  '.cm-completionDetail': {color: 'var(--muted)', fontStyle: 'normal'},
  '.cm-diagnostic': {fontFamily: 'system-ui, sans-serif', padding: '4px 8px', whiteSpace: 'pre-wrap', maxWidth: '480px'},
  '.cm-diagnostic-error': {borderLeft: '3px solid var(--problem)'},
  '.cm-lintRange-error': {backgroundImage: 'none', textDecoration: 'underline wavy var(--problem)', textUnderlineOffset: '3px'},
  '.cm-lint-marker-error': {content: '""', width: '8px', height: '8px', margin: '6px 2px', borderRadius: '4px', backgroundColor: 'var(--problem)'},
  '.cm-panels': {backgroundColor: 'var(--page)', color: 'var(--text)', borderColor: 'var(--line)'},
  '.cm-foldPlaceholder': {backgroundColor: 'var(--hover)', border: 'none', color: 'var(--muted)'},
});

const colours = HighlightStyle.define([
  {tag: tags.propertyName, color: 'var(--accent)'},
  {tag: tags.string, color: 'var(--text)'},
  {tag: [tags.number, tags.bool, tags.null], color: 'var(--added)'},
  {tag: tags.invalid, color: 'var(--problem)'},
]);

const plain = (text: string) => {
  try {
    return String(JSON.parse(text));
  } catch {
    return text.replace(/"/g, '');
  }
};

/// The keys that lead to a node, and the object that it stands in.
function placeOf(state: EditorState, node: SyntaxNode | null, isKey: boolean): Place {
  const text = (n: SyntaxNode) => state.doc.sliceString(n.from, n.to);
  const path: string[] = [];
  let object: SyntaxNode | null = null;
  for (let at = node; at; at = at.parent) {
    if (at.name === 'Property' && !(isKey && object === null)) path.unshift(at.firstChild ? plain(text(at.firstChild)) : '');
    if (at.name === 'Array') path.unshift('0');
    if (at.name === 'Object' && object === null) object = at;
  }
  const members: Record<string, unknown> = {};
  for (const property of object?.getChildren('Property') ?? []) {
    const [key, value] = [property.firstChild, property.lastChild];
    if (!key || !value || key === value) continue;
    try {
      members[plain(text(key))] = JSON.parse(text(value));
    } catch {
      members[plain(text(key))] = null;
    }
  }
  return {path, isKey, members};
}

function completion(known: Wishes['known']) {
  return (context: CompletionContext) => {
    const node = syntaxTree(context.state).resolveInner(context.pos, -1);
    const inText = node.name === 'String' || node.name === 'PropertyName';
    const before = context.state.doc.sliceString(Math.max(0, context.pos - 200), context.pos).replace(/"[^"\n]*"?$/, inText ? '' : '$&').trimEnd();
    const isKey = node.name === 'PropertyName' || (!before.endsWith(':') && !before.endsWith('[') && node.parent?.name !== 'Array' && (before.endsWith('{') || before.endsWith(',')) && placeOf(context.state, node, true).path !== undefined && !inArray(node));
    if (!inText && !context.explicit) return null;
    const {document, blocks} = known();
    const offers = offersAt(placeOf(context.state, node, isKey), document, blocks);
    if (offers.length === 0) return null;
    const from = inText ? node.from : context.pos;
    const closed = inText && /^"(?:[^"\\]|\\.)*"$/.test(context.state.doc.sliceString(node.from, node.to));
    const isWholeKey = node.name === 'PropertyName' && context.state.doc.sliceString(node.to, node.to + 20).trimStart().startsWith(':');
    // What is typed is matched up to the cursor; what is taken replaces the rest of the word as well, with its quote.
    const take = (text: string) => (view: EditorView, _: Completion, from: number, to: number) => {
      const rest = closed ? /^[^"\n]*"/.exec(view.state.doc.sliceString(to, to + 200))?.[0].length ?? 0 : 0;
      view.dispatch({changes: {from, to: to + rest, insert: text}, selection: {anchor: from + text.length}});
    };
    return {
      from, filter: true,
      options: offers.map((o): Completion => ({label: inText ? `"${o.label}` : o.label, displayLabel: o.label, detail: o.detail, apply: take(isWholeKey ? JSON.stringify(o.label) : o.apply), type: isKey ? 'property' : 'constant'})),
    };
  };
}

function inArray(node: SyntaxNode): boolean {
  for (let at: SyntaxNode | null = node; at; at = at.parent) {
    if (at.name === 'Array') return true;
    if (at.name === 'Object') return false;
  }
  return false;
}

export function makeEditor(holder: HTMLElement, text: string, wishes: Wishes): Editor {
  const root = holder.shadowRoot ?? holder.attachShadow({mode: 'open'});
  root.replaceChildren();
  let isOurs = false;
  const view = new EditorView({
    root,
    parent: root,
    state: EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), foldGutter(), lintGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(), highlightSelectionMatches(),
        indentUnit.of('  '), json(), syntaxHighlighting(colours), syntaxHighlighting(defaultHighlightStyle, {fallback: true}),
        autocompletion({override: [completion(wishes.known)], icons: false}),
        EditorView.contentAttributes.of({'aria-label': 'text of the file', spellcheck: 'false'}),
        keymap.of([{key: 'Mod-s', preventDefault: true, run: () => (wishes.onSave(), true)}, ...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...historyKeymap, ...searchKeymap, indentWithTab]),
        EditorView.updateListener.of((update) => update.docChanged && !isOurs && wishes.onChange()),
        look,
      ],
    }),
  });
  // What is typed here are no keys of the canvas.
  holder.addEventListener('keydown', (e) => e.stopPropagation());
  holder.addEventListener('paste', (e) => e.stopPropagation());
  return {
    text: () => view.state.doc.toString(),
    setText(next) {
      const now = view.state.doc.toString();
      if (next === now) return;
      let head = 0;
      while (head < Math.min(now.length, next.length) && now[head] === next[head]) ++head;
      let tail = 0;
      while (tail < Math.min(now.length, next.length) - head && now[now.length - 1 - tail] === next[next.length - 1 - tail]) ++tail;
      isOurs = true;  // only what differs: the cursor stays where it is
      view.dispatch({changes: {from: head, to: now.length - tail, insert: next.slice(head, next.length - tail)}});
      isOurs = false;
    },
    tell(problems) {
      const list: Diagnostic[] = problems.filter((p) => p.line && p.line <= view.state.doc.lines).map((p) => {
        const line = view.state.doc.line(p.line!);
        const begin = line.from + /^\s*/.exec(line.text)![0].length;
        return {from: begin, to: Math.max(begin, line.to), severity: 'error', message: `${p.what}\n${p.cure}`};
      });
      view.dispatch(setDiagnostics(view.state, list));
    },
    goTo(line) {
      if (line < 1 || line > view.state.doc.lines) return;
      const at = view.state.doc.line(line).from;
      view.dispatch({selection: {anchor: at}, effects: EditorView.scrollIntoView(at, {y: 'center'})});
      view.focus();
    },
    destroy: () => view.destroy(),
  };
}
