namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Why a <see cref="ShapeWalk"/> ended.</summary>
internal enum ShapeWalkEnd
{
    /// <summary>Every face that may count was visited.</summary>
    Completed,

    /// <summary>The visitor has found what it looked for.</summary>
    Found,

    /// <summary>The walk met its limit of work.</summary>
    LimitMet,
}
