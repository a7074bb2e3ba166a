using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>Settings for preparing and drawing a scene, apart from what the scene itself declares.</summary>
public sealed record RenderSettings
{
    // Brightness of the bars beside the viewport, as a fraction of the background's.
    private const double LetterboxShade = 0.45;

    /// <summary>Settings for culling instances per frame; null to draw every instance of every fractal in every frame.</summary>
    public CullingSettings? Culling { get; init; } = new();

    /// <summary>
    /// Maximum number of instances of one fractal without <see cref="Culling"/>. Deeper fractals are drawn at a smaller depth, with a
    /// notice.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    public int InstanceBudget
    {
        get;
        init => field = RequireNotNegative(value, nameof(InstanceBudget));
    } = (int)FractalLimits.DrawnInstances.Value;

    /// <summary>
    /// Maximum number of triangles of one fractal without <see cref="Culling"/>. It limits the instances of large meshes further.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    public long TriangleBudget
    {
        get;
        init => field = RequireNotNegative(value, nameof(TriangleBudget));
    } = 200_000_000;

    /// <summary>Angle in degrees above which two adjacent faces get separate normals, where normals are generated.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The angle is not from 0 to 180.</exception>
    public double CreaseAngle
    {
        get;
        init => field = value is >= 0 and <= 180
            ? value
            : throw new ArgumentOutOfRangeException(nameof(CreaseAngle), value, "expected an angle from 0 to 180 degrees");
    } = NormalGenerator.DefaultCreaseAngle;

    /// <summary>Number of samples a pixel; 0 switches multisampling off. A driver that offers fewer uses its maximum.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    public int Samples
    {
        get;
        init => field = RequireNotNegative(value, nameof(Samples));
    } = 4;

    /// <summary>
    /// Side of the squares of pixels that are drawn as one, for frames that must be fast; they are enlarged smoothly. Above 1 there is no
    /// multisampling.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is not positive.</exception>
    public int PixelSize
    {
        get;
        init => field = value > 0 ? value : throw new ArgumentOutOfRangeException(nameof(PixelSize), value, "expected a positive number");
    } = 1;

    /// <summary>
    /// Number of frames, each moved by a part of a pixel, whose mean is shown where nothing moves: edges smaller than a pixel then hold
    /// still when the camera moves. A <see cref="FrameRenderer"/> gathers them when asked to.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    public int GatheredFrames
    {
        get;
        init => field = RequireNotNegative(value, nameof(GatheredFrames));
    } = 1;

    /// <summary>
    /// Frames keep the light of the scene as 32-bit floats, before exposure and tone curve: see <see cref="Renderer.DrawLight"/>.
    /// </summary>
    public bool KeepsLight { get; init; }

    /// <summary>Culls faces that are not seen: back faces of closed meshes, and sides of boxes that others cover.</summary>
    public bool BackFaceCulling { get; init; } = true;

    /// <summary>Removes triangles without area when a mesh is prepared.</summary>
    public bool RemoveDegenerateTriangles { get; init; } = true;

    /// <summary>Decodes and stores each texture once, however many models use it.</summary>
    public bool ShareTextures { get; init; } = true;

    /// <summary>
    /// Prepares a model when one of its objects first comes into view in a window; otherwise all models before the first frame.
    /// </summary>
    public bool LazyLoading { get; init; } = true;

    /// <summary>Draws no depth maps of lights that are dark, or light nothing visible.</summary>
    public bool LightCulling { get; init; } = true;

    /// <summary>Draws no objects into depth maps whose shadow falls on nothing visible.</summary>
    public bool CasterCulling { get; init; } = true;

    /// <summary>Computes no ambient occlusion of fractals that certainly have none: flat ones, and those of one part.</summary>
    public bool BakeSkipping { get; init; } = true;

    /// <summary>Skips bindings and uniforms that are in effect already.</summary>
    public bool FilterRedundantState { get; init; } = true;

    /// <summary>
    /// Keeps visible instances, objects and lights on the GPU for as long as they are unchanged; otherwise all are culled and uploaded
    /// for each frame.
    /// </summary>
    public bool ReuseBuffers { get; init; } = true;

    /// <summary>Points of a surface at which lighting is computed.</summary>
    public Shading Shading { get; init; } = Shading.PerPixel;

    /// <summary>Draws the shadows of directional, spot and point lights, where lighting is computed at every pixel.</summary>
    public bool Shadows { get; init; } = true;

    /// <summary>
    /// Fits the depth maps of parallel lights to what the frame shows: sharper shadows, and new maps whenever the view changes. Otherwise
    /// they show the whole scene, and stay while nothing moves but the camera.
    /// </summary>
    public bool FitShadowsToView { get; init; } = true;

    /// <summary>
    /// Darkens the light from all around where parts of a fractal hide each other's sky, where lighting is computed at every pixel. What
    /// they hide is computed when the model is prepared.
    /// </summary>
    public bool AmbientOcclusion { get; init; } = true;

    /// <summary>Draws only the edges of the triangles.</summary>
    public bool Wireframe { get; init; }

    /// <summary>Draws a grid on the plane y = 0.</summary>
    public bool Grid { get; init; }

    /// <summary>Draws the x axis red, the y axis green and the z axis blue.</summary>
    public bool Axes { get; init; }

    /// <summary>Background colour where the scene declares none.</summary>
    public Colour Background { get; init; } = DefaultBackground;

    /// <summary>A dark blue grey, against which both light and saturated surfaces stand out.</summary>
    public static Colour DefaultBackground => new(0.118, 0.133, 0.161);

    /// <summary>Returns the colour of the bars beside the viewport.</summary>
    internal static Colour LetterboxColour(Colour background) =>
        new(LetterboxShade * background.Red, LetterboxShade * background.Green, LetterboxShade * background.Blue);

    private static T RequireNotNegative<T>(T value, string name)
        where T : INumber<T> =>
        value >= T.Zero ? value : throw new ArgumentOutOfRangeException(name, value, "expected a number that is not negative");
}
