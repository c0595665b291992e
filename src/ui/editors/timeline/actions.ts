/** Actions for the timeline's display and options, and the tools for whole curves. */

import { OUTSIDE_CYCLE } from '../../../edit/keys/cycle.ts';
import { needs, needsJoint } from '../../state/actions/needs.ts';
import { allJointsText } from '../../state/joints/selected-joint.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { ChannelListKind, HandleMode, TimelineView } from '../../state/timeline.ts';
import type { Action, CurveToolName, Uses, Workbench } from '../../state/workbench.ts';
import { channelsToEdit, currentTake, ownChannelsToEdit, selectedKeysInView } from './current-take.ts';
import { OUTSIDE_LABELS } from './cycle-text.ts';
import { needsCurveInView, needsKeys, needsTimeline } from './key-actions.ts';
import { addTo, isolateOfAll, setOfAll, viewOfAll } from './listed-of-all.ts';
import type { SampleTool } from './sample-tools.ts';
import { timelineTake } from './timeline-take.ts';

const needsChannels = needs(
  'No curve is shown: select a joint that has keys, or show all channels.',
  (wb: Uses<'store' | 'timeline'>) => channelsToEdit(wb).length > 0,
);
const needsSamples = needs(
  'The take has no samples.',
  (wb: Uses<'store'>) => currentTake(wb)?.take.samples !== undefined,
);
/** Tools for keyed curves don't apply to samples. */
const needsKeyedCurve = needs(shownNot('with keys '), (wb: Uses<'store' | 'timeline'>) =>
  ownChannelsToEdit(wb).some((c) => currentTake(wb)?.take.channels[c]?.kind === 'keys'),
);
/** … except those that don't depend on interpolation. */
const needsCurve = needs(shownNot(''), (wb: Uses<'store' | 'timeline'>) => {
  const take = currentTake(wb)?.take;
  return take !== undefined && ownChannelsToEdit(wb).some((c) => take.channels[c] && take.channels[c].kind !== 'rest');
});

/** Of several selected characters, the tools are for the active one. */
function shownNot(what: string): (wb: Uses<'store' | 'timeline'>) => string {
  return (wb) => {
    const current = timelineTake(wb);
    const of = current && current.parts.length > 1 ? `of ${current.character.name}, the active character, ` : '';
    return `No curve ${what}${of}is shown.`;
  };
}

function curves(id: string, label: string, shortcuts: readonly string[], more: Omit<Action, 'id' | 'label' | 'group'>) {
  const action: Action = { id: `timeline.${id}`, label, group: 'Curves', panel: 'timeline', ...more };
  return shortcuts.length ? { ...action, shortcuts } : action;
}

export const LIST_LABELS: Readonly<Record<ChannelListKind, string>> = {
  selected: 'Selected joints',
  all: 'All channels',
  pinned: 'Pinned',
};

export const HANDLE_LABELS: Readonly<Record<HandleMode, string>> = {
  auto: 'Move opposite handle when unified',
  alone: 'Keep opposite handle',
  together: 'Always move opposite handle',
};

type Switch = 'snapsToFrames' | 'snapsToValues' | 'scaleFrame' | 'normalised' | 'showsWhy';

/** A switch of the timeline. */
function toggle(
  what: Switch,
  label: string,
  shortcuts: readonly string[],
  icon: Action['icon'],
  section: number,
): Action {
  return curves(what, label, shortcuts, {
    menu: 'Keys/Editing',
    section,
    ...(icon && { icon }),
    checked: (wb) => wb.timeline.view.get()[what],
    run: (wb) => wb.timeline.change({ [what]: !wb.timeline.view.get()[what] }),
  });
}

/** One value of a timeline option. */
function choice<K extends 'list' | 'handles' | 'onCollision'>(
  what: K,
  value: TimelineView[K],
  label: string,
  menu: NonNullable<Action['menu']>,
  section: number,
): Action {
  return curves(`${what}.${value}`, label, [], {
    menu,
    section,
    radio: true,
    checked: (wb) => wb.timeline.view.get()[what] === value,
    run(wb) {
      const change: Partial<TimelineView> = { [what]: value };
      wb.timeline.change(change);
    },
  });
}

/** Sample tools with a dialog. */
function sampleTools(tools: readonly (readonly [CurveToolName, string])[]): Action[] {
  return tools.map(([name, label]) =>
    curves(name, label, [], { menu: 'Keys/Samples', section: 15, refuses: needsSamples, run: tool(name) }),
  );
}

/** One without a dialog. */
function sampled(name: SampleTool, label: string): Action {
  return curves(`samples.${name}`, label, [], {
    menu: 'Keys/Samples',
    section: 16,
    refuses: needsSamples,
    run: async (wb) => (await import('./sample-tools.ts')).runSampleTool(wb, name),
  });
}

function move(id: string, label: string, shortcuts: readonly string[], run: (wb: Workbench) => void): Action {
  return curves(id, label, shortcuts, { menu: 'Keys/Scroll and zoom', section: 16, repeats: true, run });
}

export const TIMELINE_ACTIONS: readonly Action[] = [
  {
    id: 'timeline.jointCurves',
    name: 'Show curves of selected joints',
    label: (wb) => `Show curves of ${allJointsText(wb)}`,
    group: 'Curves',
    menu: 'View',
    section: 3,
    refuses: needsJoint,
    run(wb) {
      openPanel(wb, 'timeline', true);
      isolateOfAll(wb, undefined);
      wb.timeline.change({ tab: 'curves', list: 'selected', filter: '' });
    },
  },
  curves('simplify', 'Simplify…', [], {
    menu: 'Keys/Curve tools',
    section: 15,
    refuses: needsKeyedCurve,
    run: tool('simplify'),
  }),
  curves('resample', 'Resample…', [], {
    menu: 'Keys/Curve tools',
    section: 15,
    refuses: needsKeyedCurve,
    run: tool('resample'),
  }),
  curves('bake', 'Bake extrapolation to keys…', [], {
    menu: 'Keys/Curve tools',
    section: 15,
    refuses: needsKeyedCurve,
    run: tool('bake'),
  }),
  curves('scaleKeys', 'Scale keys…', ['Shift+T'], {
    menu: 'Keys/Curve tools',
    section: 15,
    refuses: needsKeys,
    run: tool('scaleKeys'),
  }),
  curves('scaleDrag', 'Scale selected keys (hold and drag)', ['S'], {
    refuses: needs(
      'Select keys in the curve editor first.',
      (wb) => !needsKeys(wb) && wb.timeline.view.get().tab === 'curves',
    ),
    run: (wb) => wb.timeline.scaling.set(true),
  }),
  curves('euler', 'Euler filter', [], {
    menu: 'Keys/Curve tools',
    section: 16,
    refuses: needsCurve,
    run: async (wb) => (await import('./curve-tools.ts')).runCurveTool(wb, 'euler'),
  }),
  curves('loop', 'Make loop', [], {
    menu: 'Keys/Curve tools',
    section: 16,
    // The other loop, of whole takes, is what someone with a capture looks for.
    refuses: (wb) =>
      needsKeyedCurve(wb) && 'No curve with keys is shown. For a whole take: Edit > Edit takes > Make loop…',
    explained: true,
    run: async (wb) => (await import('./curve-tools.ts')).runCurveTool(wb, 'loop'),
  }),
  ...sampleTools([
    ['convertToKeys', 'Convert to keys…'],
    ['smoothSamples', 'Smooth samples…'],
    ['resampleSamples', 'Resample samples…'],
  ]),
  sampled('crop', 'Crop samples to playback range'),
  sampled('trimStart', 'Trim samples before current time'),
  sampled('trimEnd', 'Trim samples after current time'),
  sampled('split', 'Split take at current time'),
  sampled('reverse', 'Reverse take'),
  toggle('snapsToFrames', 'Snap to frames', ['Shift+F'], 'snapFrames', 15),
  toggle('snapsToValues', 'Snap to values', ['Shift+V'], 'snapValues', 15),
  choice('onCollision', 'replace', 'Overlapping keys: replace', 'Keys/Editing', 16),
  choice('onCollision', 'step', 'Overlapping keys: keep both (step)', 'Keys/Editing', 16),
  ...(['ask', ...OUTSIDE_CYCLE] as const).map((how) =>
    curves(
      `outsideCycle.${how}`,
      `Keys outside a cycle: ${how === 'ask' ? 'ask' : OUTSIDE_LABELS[how].toLowerCase()}`,
      [],
      {
        menu: 'Keys/Editing',
        section: 19,
        radio: true,
        checked: (wb) => wb.timeline.outsideCycle.get() === how,
        run: (wb) => wb.timeline.outsideCycle.set(how),
      },
    ),
  ),
  choice('handles', 'auto', HANDLE_LABELS.auto, 'Keys/Editing', 17),
  choice('handles', 'alone', HANDLE_LABELS.alone, 'Keys/Editing', 17),
  choice('handles', 'together', HANDLE_LABELS.together, 'Keys/Editing', 17),
  toggle('scaleFrame', 'Transform box', ['T'], 'scaleFrame', 18),
  toggle('showsWhy', 'Why this curve', [], 'why', 18),
  choice('list', 'selected', LIST_LABELS.selected, 'Keys/Channels', 15),
  choice('list', 'all', LIST_LABELS.all, 'Keys/Channels', 15),
  choice('list', 'pinned', LIST_LABELS.pinned, 'Keys/Channels', 15),
  curves('pin', 'Pin channels', ['Shift+P'], {
    menu: 'Keys/Channels',
    section: 17,
    refuses: needsChannels,
    run: (wb) => addTo(wb, 'pinned', channelsToEdit(wb)),
  }),
  curves('unpinAll', 'Unpin all', [], {
    menu: 'Keys/Channels',
    section: 17,
    refuses: needs('No channel is pinned.', (wb) => viewOfAll(wb).pinned.length > 0),
    run: (wb) => setOfAll(wb, 'pinned', []),
  }),
  curves('isolate', 'Isolate channels of selected keys', ['Q'], {
    menu: 'Keys/Channels',
    section: 18,
    refuses: needs('Select keys first.', (wb) => !needsKeys(wb) || viewOfAll(wb).isolated !== undefined),
    checked: (wb) => viewOfAll(wb).isolated !== undefined,
    run(wb) {
      const isIsolated = viewOfAll(wb).isolated !== undefined;
      isolateOfAll(wb, isIsolated ? undefined : selectedKeysInView(wb).map((k) => k.channel));
    },
  }),
  curves('hide', 'Hide channels of selected keys', ['Shift+H'], {
    menu: 'Keys/Channels',
    section: 18,
    refuses: needsKeys,
    run: (wb) =>
      addTo(
        wb,
        'hidden',
        selectedKeysInView(wb).map((k) => k.channel),
      ),
  }),
  curves('showAll', 'Show all channels', ['Alt+H'], {
    menu: 'Keys/Channels',
    section: 18,
    refuses: needsTimeline,
    run(wb) {
      isolateOfAll(wb, undefined);
      setOfAll(wb, 'hidden', []);
      wb.timeline.change({ filter: '' });
    },
  }),
  curves('fitSelected', 'Fit selected keys', ['F'], {
    menu: 'Keys/Scroll and zoom',
    section: 15,
    icon: 'frame',
    refuses: needsCurveInView,
    run: (wb) => wb.timeline.tab?.fitSelected(),
  }),
  curves('fitAll', 'Fit all', ['A'], {
    menu: 'Keys/Scroll and zoom',
    section: 15,
    icon: 'fitAll',
    refuses: needsTimeline,
    run: (wb) => wb.timeline.tab?.fitAll(),
  }),
  {
    ...toggle('normalised', 'Normalised', ['N'], 'normalised', 15),
    menu: 'Keys/Scroll and zoom',
  },
  move('zoomIn', 'Zoom in', ['+', '='], (wb) => wb.timeline.tab?.zoom?.(1 / ZOOM, 1 / ZOOM)),
  move('zoomOut', 'Zoom out', ['-'], (wb) => wb.timeline.tab?.zoom?.(ZOOM, ZOOM)),
  move('zoomTimeIn', 'Zoom time in', ['Ctrl+Alt+Right'], (wb) => wb.timeline.tab?.zoom?.(1 / ZOOM, 1)),
  move('zoomTimeOut', 'Zoom time out', ['Ctrl+Alt+Left'], (wb) => wb.timeline.tab?.zoom?.(ZOOM, 1)),
  move('zoomValueIn', 'Zoom values in', ['Ctrl+Alt+Up'], (wb) => wb.timeline.tab?.zoom?.(1, 1 / ZOOM)),
  move('zoomValueOut', 'Zoom values out', ['Ctrl+Alt+Down'], (wb) => wb.timeline.tab?.zoom?.(1, ZOOM)),
  move('panLeft', 'Scroll left', ['Shift+PageUp'], (wb) => wb.timeline.tab?.pan?.(-PAN, 0)),
  move('panRight', 'Scroll right', ['Shift+PageDown'], (wb) => wb.timeline.tab?.pan?.(PAN, 0)),
  move('panUp', 'Scroll up', ['PageUp'], (wb) => wb.timeline.tab?.pan?.(0, PAN)),
  move('panDown', 'Scroll down', ['PageDown'], (wb) => wb.timeline.tab?.pan?.(0, -PAN)),
];

const ZOOM = 1.25;
const PAN = 0.25;

function tool(name: CurveToolName) {
  return (wb: Uses<'store' | 'dialog'>) => {
    if (currentTake(wb)) wb.dialog.set(name);
  };
}
