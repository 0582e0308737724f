/**
 * What can be said of an option that a function does not know: where it belongs, or what may have been meant. `options` are the names
 * that there are, by the function or the option whose they are.
 */
export function hintsOf(options) {
  const places = Object.entries(options).map(([place, names]) => [place, names.split(' ')]);
  const all = [...new Set(places.flatMap(([, names]) => names))];
  return (path) => {
    const name = path.slice(path.lastIndexOf('.') + 1);
    const belongsTo = places.filter(([, names]) => names.includes(name)).map(([place]) => place);
    if (belongsTo.length > 0) {
      return {
        text: ` here; \`${belongsTo.join('`, `')}\` ${belongsTo.length > 1 ? 'take' : 'takes'} it`,
        detail: { belongsTo },
      };
    }
    const [meant, steps] = nearest(name, all);
    return steps <= Math.min(2, name.length / 3) ? { text: `; did you mean \`${meant}\`?`, detail: { meant } } : null;
  };
}

/** The name that the fewest steps lead to, and how many. */
function nearest(name, names) {
  const lower = name.toLowerCase();
  const steps = names.map((other) => distance(lower, other.toLowerCase()));
  const least = Math.min(...steps);
  return [names[steps.indexOf(least)], least];
}

/** How many letters have to be put in, left out, replaced or swapped with the next one. */
function distance(a, b) {
  let [before, last, row] = [[], [], Array.from({ length: b.length + 1 }, (_, j) => j)];
  for (let i = 1; i <= a.length; i++) {
    [before, last, row] = [last, row, [i]];
    for (let j = 1; j <= b.length; j++) {
      row[j] = Math.min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1])
        row[j] = Math.min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.length];
}
