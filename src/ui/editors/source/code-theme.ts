/** Styles of the field that a text is edited in: the page's widgets, by the page's variables, in a shadow root. */
import type { Extension } from '@codemirror/state';
import { EditorView } from '@codemirror/view';

const tinted = (colour: string) => `color-mix(in srgb, var(--${colour}) 25%, var(--surface))`;

/** Marks of problems are characters: the pictures that CodeMirror has for them would break the page's policy. */
function problem(severity: string, colour: string) {
  return {
    [`.cm-lint-marker-${severity}`]: {
      content: 'normal',
      color: `var(--${colour})`,
      backgroundColor: tinted(colour),
      '&::before': { content: '"!"' },
    },
    [`.cm-lintRange-${severity}`]: { backgroundImage: 'none', textDecoration: `underline wavy var(--${colour})` },
    [`.cm-diagnostic-${severity}`]: { borderLeft: `3px solid var(--${colour})` },
  };
}

const box = { boxSizing: 'border-box', height: 'var(--control)', borderRadius: 'var(--radius)', font: 'inherit' };
const focused = { outline: '2px solid var(--accent)', outlineOffset: '-1px' };

export const codeTheme: Extension = EditorView.theme({
  '&': { height: '100%', backgroundColor: 'var(--field)', color: 'var(--text)', fontSize: '12px' },
  '&.cm-focused': { outline: 'none' },
  '&.cm-focused .cm-scroller': { boxShadow: 'inset 0 0 0 2px var(--accent)' },
  '.cm-scroller': {
    fontFamily: 'var(--mono)',
    fontVariantNumeric: 'tabular-nums',
    lineHeight: '18px',
    scrollbarColor: 'var(--line-strong) transparent',
    scrollbarWidth: 'thin',
  },
  '.cm-content': { padding: '0', caretColor: 'var(--text)' },
  '.cm-line': { padding: '0 10px' },
  '.cm-word': { color: 'var(--accent)' },
  '&.cm-focused .cm-matchingBracket': { backgroundColor: 'var(--accent-quiet)', outline: '1px solid var(--accent)' },
  '&.cm-focused .cm-nonmatchingBracket': { backgroundColor: 'transparent', outline: '1px solid var(--error)' },
  // Nested either way.
  '.cm-searchMatch, .cm-searchMatch .cm-word': { color: 'var(--text)' },
  '.cm-searchMatch': { backgroundColor: 'var(--accent-quiet)' },
  '.cm-searchMatch-selected': { backgroundColor: 'var(--selected-quiet)', outline: '1px solid var(--selected)' },
  '.cm-gutters': {
    border: '0',
    borderRight: '1px solid var(--line)',
    backgroundColor: 'var(--surface)',
    color: 'var(--text-faint)',
  },
  '.cm-lineNumbers .cm-gutterElement': { minWidth: 'calc(3ch + 12px)', padding: '0 8px 0 4px' },
  '.cm-gutter-lint': { width: '16px', '& .cm-gutterElement': { padding: '0' } },
  '.cm-lint-marker': { width: '100%', height: '18px', fontWeight: '700', textAlign: 'center' },
  ...problem('error', 'error'),
  ...problem('warning', 'warning'),
  ...problem('info', 'info'),
  '.cm-lintRange': { paddingBottom: '0' },
  '.cm-lintPoint::after': { borderBottomColor: 'var(--error)' },
  '.cm-tooltip': {
    border: '1px solid var(--line-strong)',
    borderRadius: 'var(--radius)',
    backgroundColor: 'var(--raised)',
    boxShadow: 'var(--float-shadow)',
    color: 'var(--text)',
    font: 'var(--font-size) / 16px var(--font)',
  },
  '.cm-panels': { backgroundColor: 'var(--surface)', color: 'var(--text)', zIndex: '1' },
  '.cm-panels.cm-panels-top': { borderBottom: '1px solid var(--line)' },
  '.cm-panel.cm-search': {
    display: 'flex',
    flexWrap: 'wrap',
    alignItems: 'center',
    padding: '4px 6px',
    font: 'var(--font-size) / 16px var(--font)',
    gap: '4px 12px',
    '& > div': { display: 'flex', flexWrap: 'wrap', alignItems: 'center', gap: '4px' },
    '& input, & button, & label': { margin: '0' },
    '& label': {
      display: 'flex',
      alignItems: 'center',
      minHeight: 'var(--control)',
      paddingRight: '6px',
      fontSize: 'inherit',
      gap: '4px',
    },
    '& input[type=checkbox]': { margin: '0', accentColor: 'var(--accent)' },
    '& input[type=checkbox]:focus-visible': focused,
  },
  '.cm-matches': { minWidth: '0', flex: '1', color: 'var(--text-faint)' },
  '.cm-textfield': {
    ...box,
    width: '160px',
    padding: '0 6px',
    border: '1px solid var(--line-strong)',
    backgroundColor: 'var(--field)',
    color: 'var(--text)',
    '&:focus-visible': focused,
  },
  '.cm-textfield::placeholder': { color: 'var(--text-faint)' },
  '.cm-button': {
    ...box,
    padding: '0 8px',
    border: '1px solid var(--line)',
    backgroundColor: 'var(--raised)',
    backgroundImage: 'none',
    color: 'var(--text)',
    '&:hover': { backgroundColor: 'var(--hover)' },
    '&:active': { backgroundImage: 'none' },
    '&:focus-visible': focused,
  },
});
