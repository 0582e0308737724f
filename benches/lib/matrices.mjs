// Compressed sparse columns for CHOLMOD, made from what `TriMesh.laplacian` gives, with both triangles of each matrix.

/** The rows and columns of a square matrix that `keep` marks. */
export function principal({ rows: n, columnPointers, rowIndices, values }, keep) {
  const place = new Int32Array(n).fill(-1);
  let count = 0;
  for (let v = 0; v < n; v++) if (keep[v]) place[v] = count++;
  const offsets = new Uint32Array(count + 1);
  const [rows, entries] = [[], []];
  for (let v = 0; v < n; v++) {
    if (!keep[v]) continue;
    for (let k = columnPointers[v]; k < columnPointers[v + 1]; k++) {
      if (!keep[rowIndices[k]]) continue;
      rows.push(place[rowIndices[k]]);
      entries.push(values[k]);
    }
    offsets[place[v] + 1] = rows.length;
  }
  return { offsets, rows: Uint32Array.from(rows), values: Float64Array.from(entries) };
}

/** LᵀL of a symmetric L, plus a diagonal. */
export function squared({ rows: n, columnPointers, rowIndices, values }, diagonal) {
  const offsets = new Uint32Array(n + 1);
  const [rows, entries] = [[], []];
  const sums = new Float64Array(n);
  const owner = new Int32Array(n).fill(-1);
  for (let j = 0; j < n; j++) {
    const met = [];
    for (let a = columnPointers[j]; a < columnPointers[j + 1]; a++) {
      const k = rowIndices[a];
      for (let b = columnPointers[k]; b < columnPointers[k + 1]; b++) {
        const i = rowIndices[b];
        if (owner[i] !== j) {
          owner[i] = j;
          sums[i] = i === j ? diagonal[j] : 0;
          met.push(i);
        }
        sums[i] += values[a] * values[b];
      }
    }
    for (const i of met.sort((x, y) => x - y)) {
      rows.push(i);
      entries.push(sums[i]);
    }
    offsets[j + 1] = rows.length;
  }
  return { offsets, rows: Uint32Array.from(rows), values: Float64Array.from(entries) };
}
