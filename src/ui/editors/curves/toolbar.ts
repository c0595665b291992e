/** The curve editor's buttons, in the row of tabs. All of them run actions. */

import { TANGENT_CHOICES, type TangentChoice } from '../../../model/takes/tangent-kinds.ts';
import { findAction, isChecked, isEnabled, tryAction } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { HANDLE_MODES, type HandleMode } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, write } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { type IconName, icon, setIcon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { setTooltip, type TooltipText } from '../../widgets/tooltip.ts';
import { HANDLE_LABELS } from '../timeline/actions.ts';
import { hasTangents, sideWithTangents } from '../timeline/tangent-state.ts';
import { CURVE_TOOLS, entriesOf, SAMPLE_TOOLS } from './context-menu.ts';
import { keyFields } from './key-fields.ts';

const HANDLE_ICONS: Readonly<Record<HandleMode, IconName>> = {
  auto: 'handlesAuto',
  alone: 'handlesAlone',
  together: 'handlesTogether',
};

/** Groups that collapse into menus when the row is narrow (`curves.css`), with the menus' entries. */
const YIELDING: Readonly<Record<string, readonly string[]>> = {
  'handle-tools': ['unify', 'break', ...HANDLE_MODES.map((mode) => `handles.${mode}`)],
  'key-tools': ['insertKey', 'delete', 'onCollision.replace', 'onCollision.step'],
  'snap-tools': ['snapsToFrames', 'snapsToValues', 'scaleFrame'],
  'fit-tools': ['fitSelected', 'fitAll', 'normalised', 'showsWhy'],
};

const EXTRAPOLATIONS = ['constant', 'linear', 'cycle', 'cycle_offset', 'bounce'];

export function curveToolbar(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
): HTMLElement {
  const tools: (() => void)[] = [];
  const tool = (id: string, label: string, name: IconName, text: TooltipText = label) => {
    const action = findAction(wb, `timeline.${id}`);
    const made = keepsFocusElsewhere(
      button(label, { class: 'tool' }, icon(name), () => action && tryAction(wb, action)),
    );
    setActionTooltip(wb, made, `timeline.${id}`, text);
    tools.push(() => {
      const checked = action && isChecked(wb, action);
      if (checked !== undefined) setAttribute(made, 'aria-pressed', String(checked));
      write(made, 'disabled', !(action && isEnabled(wb, action)));
    });
    return made;
  };
  /** Pressed for the kind of the selected keys, on one half if only their tangents of that side are of it. */
  const tangents = (kind: TangentChoice, label: string) => {
    const made = tool(`tangents.${kind}`, label, kind, () => `${label}${whichKeys(wb, kind)}`);
    tools.push(() => setAttribute(made, 'data-side', sideWithTangents(wb, kind)));
    return made;
  };
  const menu = (label: string, name: IconName, entries: () => readonly MenuEntry[]) => {
    const made = keepsFocusElsewhere(
      element('button', { type: 'button', class: 'tool', 'aria-label': label, tooltip: label }, icon(name)),
    );
    menuButton(made, label, entries);
    return made;
  };
  const handles = menu('Opposite handle', HANDLE_ICONS.auto, () =>
    entriesOf(
      wb,
      HANDLE_MODES.map((mode) => `handles.${mode}`),
    ),
  );
  const collision = menu('Overlapping keys', 'collideReplace', () =>
    entriesOf(wb, ['onCollision.replace', 'onCollision.step']),
  );
  const showModes = () => {
    const view = wb.timeline.view.get();
    setIcon(handles, HANDLE_ICONS[view.handles]);
    setTooltip(handles, `Dragging a handle: ${HANDLE_LABELS[view.handles].toLowerCase()}`);
    const replaces = view.onCollision === 'replace';
    setIcon(collision, replaces ? 'collideReplace' : 'collideStep');
    setTooltip(collision, `Overlapping keys: ${replaces ? 'replace' : 'keep both (step)'}`);
  };
  const extrapolation = (side: string) => () => EXTRAPOLATIONS.map((e) => `extrapolation.${side}.${e}`);
  const group = (label: string, name: string, ...children: HTMLElement[]) =>
    toolbar(element('div', { class: `tools ${name}`, 'aria-label': label }, ...children));
  const isHidden = (name: string) => bar.querySelector(`.${name}`)?.getClientRects().length === 0;
  const more = menu('More tools', 'more', () =>
    Object.entries(YIELDING)
      .filter(([name]) => isHidden(name))
      .flatMap(([, ids], i) => [...(i ? [{ kind: 'line' } as const] : []), ...entriesOf(wb, ids)]),
  );
  more.classList.add('more-tools');

  const bar = element(
    'div',
    { class: 'curve-tools', role: 'group', 'aria-label': 'Curve tools' },
    group('Tangents', 'tangent-tools', ...TANGENT_CHOICES.map(({ name, label }) => tangents(name, label))),
    group(
      'Handles',
      'handle-tools',
      tool('unify', 'Unify tangents', 'unify'),
      tool('break', 'Break tangents', 'break'),
      handles,
    ),
    group(
      'Keys',
      'key-tools',
      tool('insertKey', 'Insert key at current time', 'insertKey'),
      tool('delete', 'Delete selected keys', 'deleteKey'),
      collision,
    ),
    group(
      'Snapping',
      'snap-tools',
      tool('snapsToFrames', 'Snap to frames', 'snapFrames'),
      tool('snapsToValues', 'Snap to values', 'snapValues'),
      tool('scaleFrame', 'Transform box', 'scaleFrame'),
    ),
    group(
      'Curves',
      'whole-tools',
      menu('Extrapolation before and after the keys', 'extrapolate_cycle_offset', () => [
        { kind: 'note', text: 'Before and after' },
        ...entriesOf(wb, extrapolation('both')()),
        { kind: 'line' },
        { kind: 'menu', label: 'Before the keys', entries: () => entriesOf(wb, extrapolation('in')()) },
        { kind: 'menu', label: 'After the keys', entries: () => entriesOf(wb, extrapolation('out')()) },
      ]),
      menu('Curve tools', 'curveTools', () => [
        ...entriesOf(wb, CURVE_TOOLS),
        { kind: 'line' },
        { kind: 'note', text: 'Samples' },
        ...entriesOf(wb, SAMPLE_TOOLS),
      ]),
    ),
    group(
      'View',
      'fit-tools',
      tool('fitSelected', 'Fit selected keys', 'frame'),
      tool('fitAll', 'Fit all', 'fitAll'),
      tool('normalised', 'Normalised', 'normalised'),
      tool('showsWhy', 'Why this curve', 'why'),
    ),
    more,
    keyFields(wb),
  );
  const show = oncePerFrame(() => {
    for (const update of tools) update();
    showModes();
  });
  wb.store.subscribe((now, before) => {
    if (now.document !== before.document || now.selection !== before.selection) show();
  });
  wb.timeline.view.subscribe(show);
  show();
  return bar;
}

/** Which of the selected keys have that kind of tangents. */
function whichKeys(wb: Uses<'store' | 'timeline'>, kind: TangentChoice): string {
  const has = hasTangents(wb, kind, 'both');
  if (has !== 'mixed') return has ? ': all selected keys' : '';
  const side = sideWithTangents(wb, kind);
  return side ? `: ${side === 'in' ? 'before' : 'after'} all selected keys` : ': some selected keys';
}
