/** The page's message to a waiting version of its service worker: the user wants it now. */
export const TAKE_OVER = 'take over';
