/** What every saved page has, by `plugins/web-page.ts`; see `PageScripts`. */
declare module 'virtual:web-page' {
  export const viewer: string;
  export const loader: string;
  export const style: string;
  export const policy: string;
}
