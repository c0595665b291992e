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

type Parts = Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>;

export function curveToolbar(wb: Parts): HTMLElement {
  return new CurveToolbar(wb).element;
}

class CurveToolbar {
  readonly element: HTMLElement;
  private readonly updates: (() => void)[] = [];
  private readonly handles: HTMLButtonElement;
  private readonly collision: HTMLButtonElement;

  constructor(private readonly wb: Parts) {
    const modes = HANDLE_MODES.map((mode) => `handles.${mode}`);
    this.handles = menu('Opposite handle', HANDLE_ICONS.auto, () => entriesOf(wb, modes));
    this.collision = menu('Overlapping keys', 'collideReplace', () =>
      entriesOf(wb, ['onCollision.replace', 'onCollision.step']),
    );
    this.element = element(
      'div',
      { class: 'curve-tools', role: 'group', 'aria-label': 'Curve tools' },
      ...this.groups(),
      this.more(),
      keyFields(wb),
    );
    const show = oncePerFrame(() => {
      for (const update of this.updates) update();
      this.showModes();
    });
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) show();
    });
    wb.timeline.view.subscribe(show);
    show();
  }

  private groups(): readonly HTMLElement[] {
    return [
      group('Tangents', 'tangent-tools', ...TANGENT_CHOICES.map(({ name, label }) => this.tangents(name, label))),
      group(
        'Handles',
        'handle-tools',
        this.tool('unify', 'Unify tangents', 'unify'),
        this.tool('break', 'Break tangents', 'break'),
        this.handles,
      ),
      group(
        'Keys',
        'key-tools',
        this.tool('insertKey', 'Insert key at current time', 'insertKey'),
        this.tool('delete', 'Delete selected keys', 'deleteKey'),
        this.collision,
      ),
      group(
        'Snapping',
        'snap-tools',
        this.tool('snapsToFrames', 'Snap to frames', 'snapFrames'),
        this.tool('snapsToValues', 'Snap to values', 'snapValues'),
        this.tool('scaleFrame', 'Transform box', 'scaleFrame'),
      ),
      group('Curves', 'whole-tools', ...wholeMenus(this.wb)),
      group(
        'View',
        'fit-tools',
        this.tool('fitSelected', 'Fit selected keys', 'frame'),
        this.tool('fitAll', 'Fit all', 'fitAll'),
        this.tool('normalised', 'Normalised', 'normalised'),
        this.tool('showsWhy', 'Why this curve', 'why'),
      ),
    ];
  }

  private tool(id: string, label: string, name: IconName, text: TooltipText = label): HTMLButtonElement {
    const { wb } = this;
    const action = findAction(wb, `timeline.${id}`);
    const made = keepsFocusElsewhere(
      button(label, { class: 'tool' }, icon(name), () => action && tryAction(wb, action)),
    );
    setActionTooltip(wb, made, `timeline.${id}`, text);
    this.updates.push(() => {
      const checked = action && isChecked(wb, action);
      if (checked !== undefined) setAttribute(made, 'aria-pressed', String(checked));
      write(made, 'disabled', !(action && isEnabled(wb, action)));
    });
    return made;
  }

  /** Pressed for the kind of the selected keys, on one half if only their tangents of that side are of it. */
  private tangents(kind: TangentChoice, label: string): HTMLButtonElement {
    const { wb } = this;
    const made = this.tool(`tangents.${kind}`, label, kind, () => `${label}${whichKeys(wb, kind)}`);
    this.updates.push(() => setAttribute(made, 'data-side', sideWithTangents(wb, kind)));
    return made;
  }

  /** What has no room in the row. */
  private more(): HTMLButtonElement {
    const isHidden = (name: string) => this.element.querySelector(`.${name}`)?.getClientRects().length === 0;
    const made = menu('More tools', 'more', () =>
      Object.entries(YIELDING)
        .filter(([name]) => isHidden(name))
        .flatMap(([, ids], i) => [...(i ? [{ kind: 'line' } as const] : []), ...entriesOf(this.wb, ids)]),
    );
    made.classList.add('more-tools');
    return made;
  }

  private showModes(): void {
    const { handles, collision } = this;
    const view = this.wb.timeline.view.get();
    setIcon(handles, HANDLE_ICONS[view.handles]);
    setTooltip(handles, `Dragging a handle: ${HANDLE_LABELS[view.handles].toLowerCase()}`);
    const replaces = view.onCollision === 'replace';
    setIcon(collision, replaces ? 'collideReplace' : 'collideStep');
    setTooltip(collision, `Overlapping keys: ${replaces ? 'replace' : 'keep both (step)'}`);
  }
}

/** Menus for whole curves. */
function wholeMenus(wb: Parts): readonly HTMLElement[] {
  const extrapolation = (side: string) =>
    entriesOf(
      wb,
      EXTRAPOLATIONS.map((e) => `extrapolation.${side}.${e}`),
    );
  return [
    menu('Extrapolation before and after the keys', 'extrapolate_cycle_offset', () => [
      { kind: 'note', text: 'Before and after' },
      ...extrapolation('both'),
      { kind: 'line' },
      { kind: 'menu', label: 'Before the keys', entries: () => extrapolation('in') },
      { kind: 'menu', label: 'After the keys', entries: () => extrapolation('out') },
    ]),
    menu('Curve tools', 'curveTools', () => [
      ...entriesOf(wb, CURVE_TOOLS),
      { kind: 'line' },
      { kind: 'note', text: 'Samples' },
      ...entriesOf(wb, SAMPLE_TOOLS),
    ]),
  ];
}

function group(label: string, name: string, ...children: HTMLElement[]): HTMLElement {
  return toolbar(element('div', { class: `tools ${name}`, 'aria-label': label }, ...children));
}

function menu(label: string, name: IconName, entries: () => readonly MenuEntry[]): HTMLButtonElement {
  const made = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool', 'aria-label': label, tooltip: label }, icon(name)),
  );
  menuButton(made, label, entries);
  return made;
}

/** Which of the selected keys have that kind of tangents. */
function whichKeys(wb: Uses<'store' | 'timeline'>, kind: TangentChoice): string {
  const has = hasTangents(wb, kind, 'both');
  if (has !== 'mixed') return has ? ': all selected keys' : '';
  const side = sideWithTangents(wb, kind);
  return side ? `: ${side === 'in' ? 'before' : 'after'} all selected keys` : ': some selected keys';
}
