namespace FractalEngine.Core.Physics.Islands;

/// <summary>Bodies that touch, directly or through others, as ranges of the lists of a <see cref="ContactGraph"/>.</summary>
/// <param name="FirstRow">Index of its first contact.</param>
/// <param name="RowCount">Number of its contacts.</param>
/// <param name="FirstBody">Place of its first body.</param>
/// <param name="BodyCount">Number of its bodies, at least two.</param>
internal readonly record struct Island(int FirstRow, int RowCount, int FirstBody, int BodyCount);
