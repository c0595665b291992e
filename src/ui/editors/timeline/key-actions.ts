/** Actions on the selected keys. Their shortcuts belong to the timeline and have other meanings elsewhere. */

import { EXTRAPOLATION_NAMES } from '../../../edit/commands/extrapolation.ts';
import { walkChannels, walkKeys } from '../../../edit/keys/key-walk.ts';
import { stepFrames } from '../../../edit/playback.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { type Channel, EXTRAPOLATIONS, type Extrapolation } from '../../../model/takes/take.ts';
import { TANGENT_CHOICES, TANGENTS } from '../../../model/takes/tangent-kinds.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { NO_CHARACTER, needs } from '../../state/actions/needs.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import {
  channelsInView,
  channelsToEdit,
  currentTake,
  selectedKeysInView,
  selectKeys,
  takeTime,
} from './current-take.ts';
import {
  copyToTray,
  deleteKeys,
  duplicate,
  extrapolate,
  insertAtPlayhead,
  invertSelection,
  joinTangents,
  makeTangents,
  nudge,
  paste,
  selectWhere,
  snapToFrames,
} from './key-edits.ts';
import { pastableChannels } from './paste-targets.ts';
import { hasTangents } from './tangent-state.ts';
import { timelineTake } from './timeline-take.ts';

function noTakeText(wb: Uses<'store'>): string {
  const character = currentCharacter(wb);
  return character ? `${character.name} has no take: pose a joint and press K to start one.` : NO_CHARACTER;
}

export const needsKeys = needs(
  (wb) => (timelineTake(wb) ? 'Select keys first.' : noTakeText(wb)),
  (wb: Uses<'store' | 'timeline'>) => selectedKeysInView(wb).length > 0,
);
/** Of the current character. */
export const needsTake = needs(noTakeText, (wb: Uses<'store'>) => currentTake(wb) !== undefined);
/** Of any selected character. */
export const needsTimeline = needs(noTakeText, (wb: Uses<'store'>) => timelineTake(wb) !== undefined);
const needsCopied = needs(
  (wb) => (timelineTake(wb) ? 'Copy keys first.' : noTakeText(wb)),
  (wb: Uses<'store' | 'timeline'>) => timelineTake(wb) !== undefined && wb.timeline.copied !== undefined,
);
export const needsCurveInView = needs(
  (wb) =>
    timelineTake(wb) ? 'No curve is shown: select a joint that has keys, or show all channels.' : noTakeText(wb),
  (wb: Uses<'store' | 'timeline'>) => channelsInView(wb).length > 0,
);

/** An action of the timeline panel. */
function key(id: string, label: string, shortcuts: readonly string[], more: Omit<Action, 'id' | 'label' | 'group'>) {
  const action: Action = { id: `timeline.${id}`, label, group: 'Keys', panel: 'timeline', ...more };
  return shortcuts.length ? { ...action, shortcuts } : action;
}

const edits: readonly Action[] = [
  key('insertKey', 'Insert key at current time', ['I', 'Enter'], {
    unchanged: 'The visible curves already have keys at the current time.',
    menu: 'Keys',
    section: 10,
    icon: 'insertKey',
    refuses: needsCurveInView,
    run: (wb) => insertAtPlayhead(wb),
  }),
  key('delete', 'Delete selected keys', ['Delete', 'Backspace'], {
    menu: 'Keys',
    section: 1,
    icon: 'deleteKey',
    refuses: needsKeys,
    run: deleteKeys,
  }),
  key('cut', 'Cut keys', ['Ctrl+X'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsKeys,
    run(wb) {
      if (copyToTray(wb)) deleteKeys(wb);
    },
  }),
  key('copy', 'Copy keys', ['Ctrl+C'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsKeys,
    run: (wb) => void copyToTray(wb),
  }),
  key('paste', 'Paste keys at current time', ['Ctrl+V'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsCopied,
    run: (wb) => paste(wb, 'merge'),
  }),
  key('pasteInsert', 'Ripple paste (push later keys)', ['Ctrl+Shift+V'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsCopied,
    run: (wb) => paste(wb, 'insert'),
  }),
  key('pasteInto', 'Paste into all listed channels', ['Ctrl+Alt+V'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsCopied,
    run: (wb) => paste(wb, 'merge', pastableChannels(wb)),
  }),
  key('duplicate', 'Duplicate at current time', ['Ctrl+D'], {
    menu: 'Keys/Copy and paste',
    section: 10,
    refuses: needsKeys,
    run: duplicate,
  }),
  key('snapToFrames', 'Snap keys to frames', ['Shift+S'], {
    unchanged: 'The selected keys are already on frames.',
    menu: 'Keys',
    section: 10,
    refuses: needsKeys,
    run: snapToFrames,
  }),
];

const selecting: readonly Action[] = [
  key('selectAll', 'All visible keys', ['Ctrl+A'], {
    menu: 'Keys/Select',
    section: 12,
    refuses: needsCurveInView,
    run: (wb) => selectWhere(wb, channelsInView(wb), () => true),
  }),
  key('selectNone', 'Deselect keys', ['Escape', 'Ctrl+Shift+A'], {
    quiet: true,
    menu: 'Keys/Select',
    section: 12,
    refuses: needsKeys,
    run: (wb) => selectKeys(wb, []),
  }),
  key('invert', 'Invert selection', ['Ctrl+I'], {
    menu: 'Keys/Select',
    section: 12,
    refuses: needsCurveInView,
    run: invertSelection,
  }),
  walk('nextKey', 'Next key in channel', ['Ctrl+Right', ']'], 1, false),
  walk('previousKey', 'Previous key in channel', ['Ctrl+Left', '['], -1, false),
  walk('addNextKey', 'Extend to next key', ['Ctrl+Shift+Right', '}'], 1, true),
  walk('addPreviousKey', 'Extend to previous key', ['Ctrl+Shift+Left', '{'], -1, true),
  crossing('nextChannel', 'Key in next channel', ['Ctrl+Down'], 1),
  crossing('previousChannel', 'Key in previous channel', ['Ctrl+Up'], -1),
  key('selectBefore', 'Keys before current time', [], {
    menu: 'Keys/Select',
    section: 14,
    refuses: needsCurveInView,
    run: (wb) => selectWhere(wb, channelsInView(wb), (time) => time < now(wb) - SAME_SECONDS),
  }),
  key('selectHere', 'Keys at current time', [], {
    menu: 'Keys/Select',
    section: 14,
    refuses: needsCurveInView,
    run: (wb) => selectWhere(wb, channelsInView(wb), (time) => Math.abs(time - now(wb)) <= SAME_SECONDS),
  }),
  key('selectAfter', 'Keys after current time', [], {
    menu: 'Keys/Select',
    section: 14,
    refuses: needsCurveInView,
    run: (wb) => selectWhere(wb, channelsInView(wb), (time) => time > now(wb) + SAME_SECONDS),
  }),
  key('selectChannels', 'All keys of these channels', ['Shift+L'], {
    menu: 'Keys/Select',
    section: 14,
    refuses: needsKeys,
    run: (wb) => selectWhere(wb, channelsToEdit(wb), () => true),
  }),
];

/** Times closer than this are equal. */
const SAME_SECONDS = 1e-7;

function now(wb: Uses<'transport'>): number {
  return wb.transport.get().timeSeconds;
}

/** Steps from key to key. @param next the new selection among channels in view, starting from the playhead */
function step(
  id: string,
  label: string,
  shortcuts: readonly string[],
  next: (
    channels: readonly Channel[],
    keys: readonly ChannelKeys[],
    shown: readonly number[],
    fromSeconds: number,
  ) => readonly ChannelKeys[],
): Action {
  return key(id, label, shortcuts, {
    menu: 'Keys/Select',
    section: 13,
    repeats: true,
    refuses: needsCurveInView,
    run(wb) {
      const current = timelineTake(wb);
      if (!current) return;
      const { character, take } = current;
      selectKeys(wb, next(take.channels, selectedKeysInView(wb), channelsInView(wb), takeTime(wb, character)));
    },
  });
}

function walk(id: string, label: string, shortcuts: readonly string[], by: 1 | -1, adds: boolean): Action {
  return step(id, label, shortcuts, (channels, keys, shown, from) => walkKeys(channels, keys, shown, from, by, adds));
}

/** Steps from channel to channel; with nothing selected, to the next key in time. */
function crossing(id: string, label: string, shortcuts: readonly string[], by: 1 | -1): Action {
  return step(id, label, shortcuts, (channels, keys, shown, from) =>
    keys.length ? walkChannels(channels, keys, shown, by) : walkKeys(channels, keys, shown, from, by, false),
  );
}

/** Arrow keys move the selection; with nothing selected, left and right step frames as elsewhere. */
function arrow(id: string, label: string, shortcut: string, frames: number, steps: number): Action {
  return key(id, label, [shortcut], {
    menu: 'Keys/Move',
    section: 12,
    repeats: true,
    refuses: needs('Select keys first.', (wb) => !needsKeys(wb) || Math.abs(frames) >= 1),
    run(wb) {
      if (!needsKeys(wb)) nudge(wb, frames, steps);
      else wb.transport.update((p) => stepFrames(p, frames));
    },
  });
}

const moving: readonly Action[] = [
  arrow('later', 'One frame later', 'Right', 1, 0),
  arrow('earlier', 'One frame earlier', 'Left', -1, 0),
  arrow('up', 'Up by 1° or 0.01', 'Up', 0, 1),
  arrow('down', 'Down by 1° or 0.01', 'Down', 0, -1),
  arrow('muchLater', 'Ten frames later', 'Shift+Right', 10, 0),
  arrow('muchEarlier', 'Ten frames earlier', 'Shift+Left', -10, 0),
  arrow('farUp', 'Up by ten steps', 'Shift+Up', 0, 10),
  arrow('farDown', 'Down by ten steps', 'Shift+Down', 0, -10),
  arrow('aBitLater', 'A tenth of a frame later', 'Alt+Right', 0.1, 0),
  arrow('aBitEarlier', 'A tenth of a frame earlier', 'Alt+Left', -0.1, 0),
  arrow('aBitUp', 'Up by a tenth of a step', 'Alt+Up', 0, 0.1),
  arrow('aBitDown', 'Down by a tenth of a step', 'Alt+Down', 0, -0.1),
];

const tangents: readonly Action[] = [
  ...TANGENT_CHOICES.map(({ name: kind, label }, i) =>
    key(`tangents.${kind}`, label, [String(i + 1)], {
      menu: 'Keys/Tangents',
      section: 12,
      icon: kind,
      refuses: needsKeys,
      checked: (wb) => hasTangents(wb, kind, 'both'),
      run: (wb) => makeTangents(wb, kind, 'both'),
    }),
  ),
  key('unify', 'Unify: same slope on both sides', ['U'], {
    menu: 'Keys/Tangents',
    section: 13,
    icon: 'unify',
    refuses: needsKeys,
    run: (wb) => joinTangents(wb, 'unify'),
  }),
  key('break', 'Break: separate slopes', ['B'], {
    menu: 'Keys/Tangents',
    section: 13,
    icon: 'break',
    refuses: needsKeys,
    run: (wb) => joinTangents(wb, 'break'),
  }),
  ...(['in', 'out'] as const).flatMap((side) =>
    TANGENTS.map(({ name: kind, label }) =>
      key(`tangents.${side}.${kind}`, `${label}, ${side === 'in' ? 'before' : 'after'} the key`, [], {
        menu: 'Keys/Tangents',
        section: side === 'in' ? 14 : 15,
        refuses: needsKeys,
        checked: (wb) => hasTangents(wb, kind, side),
        run: (wb) => makeTangents(wb, kind, side),
      }),
    ),
  ),
];

/** Both sides first, the most common choice. */
const extrapolations: readonly Action[] = (['both', 'in', 'out'] as const).flatMap((side) =>
  EXTRAPOLATIONS.map((extrapolation) =>
    key(`extrapolation.${side}.${extrapolation}`, extrapolationLabel(extrapolation, side), [], {
      menu: 'Keys/Extrapolation',
      section: { both: 12, in: 13, out: 14 }[side],
      icon: extrapolationIcon(extrapolation),
      radio: true,
      refuses: needsCurveInView,
      checked: (wb) => allExtrapolate(wb, side, extrapolation),
      run: (wb) => extrapolate(wb, side, extrapolation),
    }),
  ),
);

export function extrapolationIcon(extrapolation: Extrapolation) {
  return `extrapolate_${extrapolation}` as const;
}

function extrapolationLabel(extrapolation: Extrapolation, side: 'both' | 'in' | 'out'): string {
  const label = EXTRAPOLATION_NAMES[extrapolation];
  return side === 'both' ? label : `${label}, ${side === 'in' ? 'before' : 'after'} the keys`;
}

function allExtrapolate(
  wb: Uses<'store' | 'timeline'>,
  side: 'both' | 'in' | 'out',
  extrapolation: Extrapolation,
): boolean {
  const current = timelineTake(wb);
  const channels = current ? channelsToEdit(wb) : [];
  return (
    channels.length > 0 &&
    channels.every((c) => {
      const channel = current?.take.channels[c];
      const before = side === 'out' || channel?.extrapolateIn === extrapolation;
      return before && (side === 'in' || channel?.extrapolateOut === extrapolation);
    })
  );
}

export const KEY_ACTIONS: readonly Action[] = [...edits, ...selecting, ...moving, ...tangents, ...extrapolations];
