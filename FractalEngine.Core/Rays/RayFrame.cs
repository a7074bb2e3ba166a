namespace FractalEngine.Core.Rays;

/// <summary>A sub-fractal whose children a ray is tested against.</summary>
internal struct RayFrame
{
    /// <summary>The ray in its frame.</summary>
    public LocalRay Ray;

    /// <summary>The sub-fractal with its bounds.</summary>
    public RayBounds Bounds;

    /// <summary>Its remaining levels.</summary>
    public long RemainingLevels;

    /// <summary>Factor from distances along the ray of the query to the parameter of keys.</summary>
    public double PerDistance;

    /// <summary>The inverse of that.</summary>
    public double DistancePer;

    /// <summary>Where the keys of its children begin.</summary>
    public int FirstKey;

    /// <summary>Index of the child that was entered last.</summary>
    public int Child;
}
