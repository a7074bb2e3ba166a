using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>One ball of a body: where it is now, and what it touches.</summary>
internal sealed class BodyBall
{
    /// <summary>Centre relative to the body's position, world space.</summary>
    public Vector Offset { get; set; }

    /// <summary>Present radius, scene units.</summary>
    public double Radius { get; set; }

    /// <summary>True for a compound's ball that touches the closest surface, as far as it was searched for.</summary>
    public bool IsOnSurface { get; set; }

    /// <summary>True where the ball touches a surface, or another body that it has met by itself.</summary>
    public bool IsTouching => IsOnSurface || Contacts.Count > 0;

    /// <summary>Surfaces that the ball touches.</summary>
    public ContactSet Contacts { get; } = new();

    /// <summary>Known lower bound on the distance from its centre to all surfaces.</summary>
    public SafeDistance SafeDistance { get; } = new();

    /// <summary>Faces that the ball touches or may meet, and no contact knows of.</summary>
    public NearSurfaceList NearSurfaces { get; } = new();

    /// <summary>Discards everything that is known of surfaces.</summary>
    public void InvalidateSurroundings()
    {
        Contacts.Clear();
        SafeDistance.Invalidate();
        NearSurfaces.Clear();
        IsOnSurface = false;
    }
}
