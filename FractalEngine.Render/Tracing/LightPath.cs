using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>How far a path of light was followed backwards from the eye.</summary>
internal struct LightPath
{
    /// <summary>Surfaces that a path may pass through.</summary>
    private const int MaxLayers = 64;

    private int _layers;

    /// <summary>Starts a path at the eye.</summary>
    /// <param name="ray">From the eye.</param>
    /// <param name="footprint">How wide it is.</param>
    /// <param name="clip">What the camera shows, as distances along the ray.</param>
    public LightPath(Ray ray, RayFootprint footprint, (double Near, double Far) clip) =>
        (Ray, Footprint, Clip) = (ray, footprint, clip);

    /// <summary>The last part of the path.</summary>
    public Ray Ray { get; private set; }

    /// <summary>How wide the last part of the path is.</summary>
    public RayFootprint Footprint { get; private set; }

    /// <summary>Where that starts and ends, as distances along the ray.</summary>
    public (double Near, double Far) Clip { get; private set; }

    /// <summary>The light that was found so far.</summary>
    public Vector Radiance { get; set; }

    /// <summary>The part of light from the end of the path that reaches the eye.</summary>
    public Vector Throughput { get; set; } = Vector.One;

    /// <summary>Number of surfaces that have reflected the light, without those of glass.</summary>
    public int Bounces { get; private set; }

    /// <summary>Distance that was passed through layers since the last surface.</summary>
    public double DistanceBefore { get; private set; }

    /// <summary>Whether the path has met glass.</summary>
    public bool IsBehindGlass { get; private set; }

    /// <summary>Whether it has met glass since it was reflected last.</summary>
    public bool IsThroughGlass { get; private set; }

    /// <summary>Whether what it meets is the first that the eye sees.</summary>
    public readonly bool IsFirst => Bounces == 0 && !IsBehindGlass;

    /// <summary>The material of the solid that the path is in; null for air.</summary>
    public Glass? Medium { get; set; }

    /// <summary>Normal for shading of the surface that has reflected the path last; zero before the first one.</summary>
    public Vector ReflectorNormal { get; private set; }

    /// <summary>Where the path left that, ahead of layers that it has passed since.</summary>
    public Vector ReflectedFrom { get; private set; }

    /// <summary>How likely that has chosen the path's direction, per solid angle.</summary>
    public double ReflectionDensity { get; private set; }

    /// <summary>Radius of the path where it meets a surface.</summary>
    /// <param name="passed">Distance of the surface along the ray.</param>
    public readonly double WidthAt(double passed) => Footprint.RadiusAt(passed);

    /// <summary>Goes on behind a layer that lets light through, in the same direction.</summary>
    /// <param name="passed">Distance to behind the layer.</param>
    /// <returns>False where the path has passed too many.</returns>
    public bool TryPassLayer(double passed)
    {
        DistanceBefore += passed;
        Ray = Ray with { Origin = Ray.Origin + (passed * Ray.Direction) };
        Footprint = Footprint with { Radius = WidthAt(passed) };
        Clip = (Math.Max(0, Clip.Near - passed), Clip.Far - passed);
        return ++_layers <= MaxLayers;
    }

    /// <summary>Counts a surface of glass.</summary>
    /// <returns>False where the path has met too many.</returns>
    public bool TryMeetGlass() => ++_layers <= MaxLayers;

    /// <summary>Goes on where glass has mirrored or refracted the path.</summary>
    /// <param name="ray">The next part.</param>
    /// <param name="width">Radius of the path there.</param>
    public void PassGlass(Ray ray, double width)
    {
        (Ray, Footprint, Clip) = (ray, Footprint with { Radius = width }, (0, double.PositiveInfinity));
        (IsBehindGlass, IsThroughGlass) = (true, true);
    }

    /// <summary>Goes on where a surface has reflected the path.</summary>
    /// <param name="ray">The next part.</param>
    /// <param name="footprint">How wide it is.</param>
    public void Reflect(Ray ray, RayFootprint footprint)
    {
        (Ray, Footprint, Clip) = (ray, footprint, (0, double.PositiveInfinity));
        (IsThroughGlass, DistanceBefore) = (false, 0);
        Bounces++;
    }

    /// <summary>Remembers which surface reflects the path, for light that it meets next.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="origin">Where the path leaves it.</param>
    /// <param name="density">How likely it has chosen the direction, per solid angle.</param>
    public void Remember(in TracedSurface surface, Vector origin, double density) =>
        (ReflectorNormal, ReflectedFrom, ReflectionDensity) = (surface.Normal, origin, density);
}
