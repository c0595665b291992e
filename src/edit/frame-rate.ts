/**
 * The frame rate of what plays. Files store the time between frames, rounded: 0.0333333 means 1/30. The intended rate
 * is the whole number or television rate (30/1.001) that the file's digits can't be told from, unless that would lose
 * half a frame by the take's end: frames are counted as in the file.
 */
import { type Document, playingCharacters, shownClip } from '../model/document.ts';
import type { Samples } from '../model/samples.ts';

/** Television rates are whole numbers divided by this. */
const TELEVISION = 1.001;
/** Rounding never changes a rate by more than this fraction. */
const MAX_ROUNDED = 0.005;
/** Relative error of single precision. */
const MIN_ROUNDED = 1e-6;
const MAX_LOST_FRAMES = 0.5;

/** Frames per second, greater than 0. */
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

/** Samples of everything that plays and is visible; undefined for keyed takes. */
function samplesPlayed(document: Document): (Samples | undefined)[] {
  const clips = playingCharacters(document).map((c) => c.driver?.source.clip ?? shownClip(c));
  return clips.map((clip) => clip?.samples);
}

/** The frame rate of everything that plays; undefined if there are several, or keys, or nothing. */
export function sharedFrameRate(document: Document): number | undefined {
  const [rate, ...others] = samplesPlayed(document).map((samples) => samples && frameRateOf(samples));
  const isOne = rate !== undefined && others.every((r) => r !== undefined && Math.abs(r - rate) <= 1e-6 * rate);
  return isOne ? rate : undefined;
}

/** Whether any playing take is sampled. */
export function playsSamples(document: Document): boolean {
  return samplesPlayed(document).some(Boolean);
}
