/** The names of a package that was required. Node adds one of its own to what was written for `import`. */
export const namesOf = (names) =>
  Object.keys(names)
    .filter((name) => name !== '__esModule')
    .sort();
