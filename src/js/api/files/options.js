/** The options of every function, and of those options that are objects. (A test compares them with what the functions take.) */
export const options = {
  readMesh: 'format fileName weld triangleFields',
  readField: 'format fileName column vertices triangles',
  readTable: 'format fileName',
  writeMesh: 'format fields binary',
  weld: 'tolerance',
};
