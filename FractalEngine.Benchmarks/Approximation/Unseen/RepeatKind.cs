namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The kinds of models that repeat, as people build them; each is one connected mesh but the links of a chain.</summary>
internal enum RepeatKind
{
    /// <summary>A straight flight of folded steps.</summary>
    Stairs,

    /// <summary>Folded steps around an axis.</summary>
    SpiralStairs,

    /// <summary>A wall of bricks in running bond, with grooves of mortar.</summary>
    BrickWall,

    /// <summary>Rows of round columns between a floor and a ceiling.</summary>
    Temple,

    /// <summary>A grid of bars with openings.</summary>
    Grating,

    /// <summary>The thread of a bolt, in sectors of a screw.</summary>
    Bolt,

    /// <summary>A toothed wheel with a hole.</summary>
    Gear,

    /// <summary>Posts, two rails and pickets.</summary>
    Fence,

    /// <summary>Links that hang in each other without touching, straight or around a circle.</summary>
    Links,

    /// <summary>A girder of struts that meet at nodes.</summary>
    Truss,
}
