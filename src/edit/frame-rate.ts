/**
 * The frame rate of what plays. Files give the time between frames, rounded as their writer did it: 0.0333333 stands for
 * 1/30. The rate that is meant is a whole number, or one of television's (30/1.001), that the file's digits can't be told
 * from; unless by the take's last frame half a frame had got lost on the way: frames are counted as the file has them.
 */
import { type Document, playingCharacters, shownClip } from '../model/document.ts';
import type { Samples } from '../model/samples.ts';

/** Rates of television are whole ones by this. */
const TELEVISION = 1.001;
/** So far from a whole rate, as part of it, no rounding leads. */
const MAX_ROUNDED = 0.005;
/** What single precision leaves of a number, as part of it. */
const MIN_ROUNDED = 1e-6;
const MAX_LOST_FRAMES = 0.5;

/** Frames per second, above 0. */
export function frameRateOf({ frameSeconds, frameCount }: Pick<Samples, 'frameSeconds' | 'frameCount'>): number {
  const rate = 1 / frameSeconds;
  const decimals = String(frameSeconds).split('.')[1]?.length ?? 0;
  const rounding = Math.min(Math.max(10 ** -decimals, MIN_ROUNDED * frameSeconds), MAX_ROUNDED * frameSeconds);
  const isMeant = (usual: number) =>
    usual > 0 &&
    Math.abs(1 / usual - frameSeconds) <= rounding &&
    frameCount * Math.abs(usual * frameSeconds - 1) < MAX_LOST_FRAMES;
  return [Math.round(rate), Math.round(rate * TELEVISION) / TELEVISION].find(isMeant) ?? rate;
}

/** Samples of all that plays and is seen; undefined for what plays by keys. */
function samplesPlayed(document: Document): (Samples | undefined)[] {
  const clips = playingCharacters(document).map((c) => c.driver?.source.clip ?? shownClip(c));
  return clips.map((clip) => clip?.samples);
}

/** The rate of everything that plays; undefined where there are several, or keys, or nothing. */
export function sharedFrameRate(document: Document): number | undefined {
  const [rate, ...others] = samplesPlayed(document).map((samples) => samples && frameRateOf(samples));
  const isOne = rate !== undefined && others.every((r) => r !== undefined && Math.abs(r - rate) <= 1e-6 * rate);
  return isOne ? rate : undefined;
}

/** Whether anything that plays is frames rather than keys. */
export function playsSamples(document: Document): boolean {
  return samplesPlayed(document).some(Boolean);
}
