/** The corner readout: values under the pointer, and the result of a drag. */

import { keysOf } from '../../../model/takes/take.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { pixelsPerSecond, timeAt } from '../../widgets/time/time-window.ts';
import { channelName } from '../timeline/channels.ts';
import { namedIn, timelineTake } from '../timeline/timeline-take.ts';
import { type CurveHit, type CurveLine, type CurveScene, lineOf } from './scene/scene.ts';
import { valueAt } from './scene/space.ts';
import { sampleNear } from './scene/their-channels.ts';
import { curveValueText, timeText } from './tools/readout-text.ts';
import type { PointerAt } from './tools/tool.ts';

export class CurveReadout {
  private readonly place = element('span', {});
  private readonly name = element('span', { class: 'readout-name' });
  private readonly value = element('span', {});
  private readonly drag = element('span', { class: 'readout-drag' });
  readonly element = element('div', { class: 'curve-readout' }, this.drag, this.name, this.value, this.place);

  constructor(private readonly wb: Uses<'store' | 'transport' | 'settings'>) {}

  /** Shows a drag's result; empty clears it. */
  say(text: string): void {
    setText(this.drag, text);
  }

  show(scene: CurveScene | undefined, pointer: PointerAt | undefined, hover: CurveHit): void {
    write(this.element, 'hidden', !scene || !pointer);
    if (!scene || !pointer) return;
    const { wb } = this;
    const [time, name, value] = this.under(scene, pointer, hover);
    setText(this.place, timeText(wb, time));
    setText(this.name, name);
    setText(this.value, value);
  }

  /** Seconds of the transport, a channel's name, a value. */
  private under(scene: CurveScene, pointer: PointerAt, hover: CurveHit): readonly [number, string, string] {
    const { wb } = this;
    const { space, take, offsetSeconds } = scene;
    const at = timeAt(space, pointer.x);
    const line = hover.kind === 'empty' ? undefined : lineOf(scene, hover.channel);
    if (hover.kind === 'empty' || !line) return [at, '', heights(wb, scene, pointer.y)];
    const current = timelineTake(wb);
    const name = current ? channelName(namedIn(current, line.channel)) : line.name;
    if (hover.kind === 'curve') {
      const own = curveValueText(wb, line.unit, hover.value);
      return [hover.timeSeconds - offsetSeconds, name, own + this.theirsAt(scene, line, hover.timeSeconds)];
    }
    const { times, values } = keysOf(take.channels[hover.channel]);
    // The key was deleted by a drag.
    if (!(hover.index < times.length)) return [at, name, ''];
    const own = curveValueText(wb, line.unit, values[hover.index]);
    const value = own + this.theirsAt(scene, line, times[hover.index]);
    return [times[hover.index] - offsetSeconds, name, value];
  }

  /** What another program printed for a time of the take, if anything. */
  private theirsAt({ theirs, space }: CurveScene, line: CurveLine, time: number): string {
    const channel = theirs?.get(line.channel);
    const sample = channel ? sampleNear(channel, time, THEIRS_REACH / pixelsPerSecond(space)) : -1;
    return channel && sample >= 0 ? ` · yours ${curveValueText(this.wb, line.unit, channel.values[sample])}` : '';
  }
}

/** CSS pixels to the value of another program that is told with ours. */
const THEIRS_REACH = 4;

/** The pointer's value on each axis drawn. */
function heights(wb: Uses<'settings'>, scene: CurveScene, y: number): string {
  const onAxis = new Map<string, CurveLine>();
  for (const line of scene.lines) if (!line.normalise && !onAxis.has(line.axis)) onAxis.set(line.axis, line);
  return [...onAxis.values()].map((line) => curveValueText(wb, line.unit, valueAt(scene.space, line, y))).join(' / ');
}
