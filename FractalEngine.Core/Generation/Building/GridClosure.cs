namespace FractalEngine.Core.Generation.Building;

/// <summary>The directions in which a grid of corners is closed.</summary>
internal enum GridClosure
{
    /// <summary>Closed in no direction: a sheet.</summary>
    Open,

    /// <summary>The last column closes to the first one: a tube.</summary>
    Columns,

    /// <summary>The last row and column close to the first ones: a torus.</summary>
    RowsAndColumns,
}
