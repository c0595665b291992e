/** Guided first steps: which of them the page shows. */

export const GUIDES = ['firstAnimation', 'checkProgram'] as const;
export type GuideName = (typeof GUIDES)[number];
