/**
 * Context menus of the plot and the channel list. What was clicked is selected first, so that the menu applies to what
 * one sees.
 */
import { EXTRAPOLATION_NAMES } from '../../../edit/commands/extrapolation.ts';
import { allKeys, hasKey } from '../../../edit/keys/selection.ts';
import { EXTRAPOLATIONS } from '../../../model/takes/take.ts';
import { actionsOf } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import type { Uses } from '../../state/workbench.ts';
import { type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { channelName } from '../timeline/channels.ts';
import { selectedKeysInView, selectKeys } from '../timeline/current-take.ts';
import { extrapolate } from '../timeline/key-edits.ts';
import { isolateOfAll, toggleIn, viewOfAll } from '../timeline/listed-of-all.ts';
import { namedIn, timelineTake } from '../timeline/timeline-take.ts';
import { insertOnCurve } from './insert.ts';
import type { CurveHit } from './scene/scene.ts';

const LINE: MenuEntry = { kind: 'line' };
const TANGENTS = ['flat', 'linear', 'smooth', 'fixed'].map((kind) => `tangents.${kind}`);
export const SAMPLE_TOOLS = [
  'convertToKeys',
  'smoothSamples',
  'resampleSamples',
  'samples.crop',
  'samples.trimStart',
  'samples.trimEnd',
  'samples.split',
  'samples.reverse',
];
export const CURVE_TOOLS = ['simplify', 'resample', 'bake', 'euler', 'loop', 'scaleKeys'];

/** Timeline actions as entries. */
export function entriesOf(wb: Uses<'actions' | 'settings'>, ids: readonly string[]): MenuEntry[] {
  const actions = actionsOf(wb);
  return ids.flatMap((id) => actions.filter((a) => a.id === `timeline.${id}`).map((a) => itemOf(wb, a)));
}

/** By keyboard it applies to the selected keys, since nothing is under a pointer. */
export function openPlotMenu(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  hit: CurveHit,
  where: MenuPlace,
): void {
  if (hit.kind === 'key' || hit.kind === 'handle') {
    if (!hasKey(selectedKeysInView(wb), hit.channel, hit.index)) {
      selectKeys(wb, [{ channel: hit.channel, indices: [hit.index] }]);
    }
    openMenu(where, keyEntries(wb), { label: 'Key' });
  } else if (hit.kind === 'curve' && isSampledHere(wb, hit.channel)) {
    openMenu(where, sampledEntries(wb, hit.channel), { label: 'Curve' });
  } else if (hit.kind === 'curve') {
    selectCurve(wb, hit.channel);
    const { channel, timeSeconds } = hit;
    const insert: MenuEntry = {
      kind: 'item',
      label: 'Insert key here',
      enabled: true,
      run: () => insertOnCurve(wb, channel, timeSeconds),
    };
    openMenu(where, [insert, LINE, ...channelEntries(wb, channel)], { label: 'Curve' });
  } else if (where.byKeyboard && selectedKeysInView(wb).length) openMenu(where, keyEntries(wb), { label: 'Keys' });
  else openMenu(where, groundEntries(wb), { label: 'Curves' });
}

/** The menu of a channel in the list. */
export function openChannelMenu(
  wb: Uses<'store' | 'actions' | 'timeline' | 'settings'>,
  channel: number,
  where: MenuPlace,
): void {
  const current = timelineTake(wb);
  if (!current) return;
  const label = channelName(namedIn(current, channel));
  const kind = current.take.channels[channel]?.kind;
  if (kind === 'samples') {
    openMenu(where, sampledEntries(wb, channel), { label });
  } else if (kind === 'keys') {
    selectCurve(wb, channel);
    openMenu(where, channelEntries(wb, channel), { label });
  } else {
    openMenu(where, [{ kind: 'note', text: `${label} has no keys yet.` }, LINE, pinEntry(wb, channel)], { label });
  }
}

/** Selects all keys of a channel, unless some of them are selected. */
function selectCurve(wb: Uses<'store' | 'timeline'>, channel: number): void {
  const current = timelineTake(wb);
  if (!current || selectedKeysInView(wb).some((k) => k.channel === channel)) return;
  selectKeys(wb, allKeys(current.take, [channel]));
}

function keyEntries(wb: Uses<'actions' | 'settings'>): MenuEntry[] {
  const side = (label: string, name: 'in' | 'out'): MenuEntry => ({
    kind: 'menu',
    label,
    entries: () =>
      entriesOf(
        wb,
        TANGENTS.map((id) => id.replace('tangents', `tangents.${name}`)),
      ),
  });
  return [
    ...entriesOf(wb, TANGENTS),
    side('Before the key', 'in'),
    side('After the key', 'out'),
    LINE,
    ...entriesOf(wb, ['unify', 'break']),
    LINE,
    ...entriesOf(wb, ['cut', 'copy', 'paste', 'duplicate', 'delete']),
    LINE,
    ...entriesOf(wb, ['snapToFrames', 'scaleKeys', 'selectChannels', 'fitSelected']),
  ];
}

function isSampledHere(wb: Uses<'store'>, channel: number): boolean {
  return timelineTake(wb)?.take.channels[channel]?.kind === 'samples';
}

/** The menu of a sampled curve, which has no keys. */
function sampledEntries(wb: Uses<'store' | 'actions' | 'timeline' | 'settings'>, channel: number): MenuEntry[] {
  return [...showEntries(wb, channel), LINE, ...entriesOf(wb, SAMPLE_TOOLS)];
}

/** Entries for what is shown of a channel. */
function showEntries(wb: Uses<'store' | 'timeline'>, channel: number): MenuEntry[] {
  const { isolated, hidden } = viewOfAll(wb);
  const isOnly = isolated?.length === 1 && isolated[0] === channel;
  return [
    {
      kind: 'item',
      label: 'Isolate',
      checked: isOnly,
      enabled: true,
      run: () => isolateOfAll(wb, isOnly ? undefined : [channel]),
    },
    {
      kind: 'item',
      label: 'Hide',
      checked: hidden.includes(channel),
      enabled: true,
      run: () => toggleIn(wb, 'hidden', channel),
    },
    pinEntry(wb, channel),
  ];
}

function channelEntries(wb: Uses<'store' | 'actions' | 'timeline' | 'settings'>, channel: number): MenuEntry[] {
  return [
    ...showEntries(wb, channel),
    LINE,
    { kind: 'menu', label: 'Before the keys', entries: () => extrapolationEntries(wb, channel, 'in') },
    { kind: 'menu', label: 'After the keys', entries: () => extrapolationEntries(wb, channel, 'out') },
    { kind: 'menu', label: 'Curve tools', entries: () => entriesOf(wb, CURVE_TOOLS) },
    LINE,
    ...entriesOf(wb, ['cut', 'copy', 'paste', 'delete']),
  ];
}

function groundEntries(wb: Uses<'actions' | 'settings'>): MenuEntry[] {
  return [
    ...entriesOf(wb, ['insertKey', 'paste', 'pasteInsert', 'pasteInto']),
    LINE,
    ...entriesOf(wb, ['selectAll', 'invert', 'selectBefore', 'selectHere', 'selectAfter']),
    LINE,
    { kind: 'menu', label: 'Curve tools', entries: () => entriesOf(wb, CURVE_TOOLS) },
    { kind: 'menu', label: 'Samples', entries: () => entriesOf(wb, SAMPLE_TOOLS) },
    LINE,
    ...entriesOf(wb, ['fitSelected', 'fitAll', 'normalised', 'snapsToFrames', 'snapsToValues', 'scaleFrame']),
  ];
}

function pinEntry(wb: Uses<'store' | 'timeline'>, channel: number): MenuEntry {
  const checked = viewOfAll(wb).pinned.includes(channel);
  return { kind: 'item', label: 'Pin', checked, enabled: true, run: () => toggleIn(wb, 'pinned', channel) };
}

/** Extrapolation of one channel on one side. */
export function extrapolationEntries(wb: Uses<'store' | 'timeline'>, channel: number, side: 'in' | 'out'): MenuEntry[] {
  const held = timelineTake(wb)?.take.channels[channel];
  const now = side === 'in' ? held?.extrapolateIn : held?.extrapolateOut;
  return EXTRAPOLATIONS.map((extrapolation) => ({
    kind: 'item',
    label: EXTRAPOLATION_NAMES[extrapolation],
    radio: true,
    checked: extrapolation === now,
    enabled: held !== undefined,
    run: () => extrapolate(wb, side, extrapolation, [channel]),
  }));
}
