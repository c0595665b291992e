/** How a character is written for other programs, whatever the format. */
export interface ExchangeOptions {
  /** How far any joint or vertex may be off at any time, in the file's units; default `TOLERANCE_OF_SIZE` of its size. */
  readonly tolerance?: number;
  /** Keep only this many attachments of each vertex, the strongest; default all. */
  readonly influences?: number;
  /** One key a frame at this rate, exact at the frames, instead of as few keys as hold the tolerance. */
  readonly framesPerSecond?: number;
  /** Only the take of that name; default all. */
  readonly take?: string;
  /** Whether a character without a skin gets bones to be seen by. */
  readonly body: boolean;
}

/** The default tolerance, as a fraction of the character's size. */
export const TOLERANCE_OF_SIZE = 1 / 2000;
