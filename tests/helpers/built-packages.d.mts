/** Paths in the lock file of the packages that are built into the page, the command and the npm package. */
export function builtPackages(): readonly string[];
