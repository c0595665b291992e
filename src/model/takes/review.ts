/** A person's words about takes that are reviewed: part of the document, beside the takes' files. */

/** Verdicts that a person can give a take. */
export const VERDICTS = ['good', 'bad'] as const;
/** Empty: none yet. */
export type Verdict = (typeof VERDICTS)[number] | '';

/** Most stars that a take can get; 0 means none given. */
export const MAX_STARS = 5;

/** A person's words about a take. */
export interface Review {
  readonly verdict: Verdict;
  /** 0, for none, to 5. */
  readonly stars: number;
  /** Without commas, semicolons and spaces around them; each once. */
  readonly tags: readonly string[];
  readonly notes: string;
}

/** The review of a take that nobody has judged. */
export const NO_REVIEW: Review = { verdict: '', stars: 0, tags: [], notes: '' };

/** A take in the list of those that are reviewed: a file, which the document doesn't hold. */
export interface ReviewedTake extends Review {
  /** Unique in the list; with folders, `/` between them. */
  readonly path: string;
}

/** Tags out of a text: separated by commas, semicolons or line ends; each once. */
export function tagsOf(text: string): readonly string[] {
  const tags = text.split(/[,;\r\n]/).map((tag) => tag.trim());
  return [...new Set(tags)].filter((tag) => tag !== '');
}
