/**
 * Files named in the address: `?files=a.skel,a.skin,walk.anim`. Commas separate, so one inside a name is `%2C`. Nothing
 * but what the address names is ever requested (`fetch-files.ts`).
 */

/** The files named in a query string, decoded, in order. */
export function filesInQuery(query: string): readonly string[] {
  const names: string[] = [];
  for (const part of query.replace(/^\?/, '').split('&')) {
    const [key, value] = part.split(/=(.*)/s);
    if (key !== 'files' || !value) continue;
    // Split before decoding: a comma in a name is encoded.
    for (const name of value.split(',')) if (name) names.push(decoded(name));
  }
  return names;
}

function decoded(name: string): string {
  try {
    return decodeURIComponent(name.replaceAll('+', ' '));
  } catch {
    // A lone `%` is part of the name.
    return name;
  }
}

/** The path that a file of an address has. */
export function pathOf({ pathname }: URL): string {
  return decoded(pathname.replace(/^\//, ''));
}
