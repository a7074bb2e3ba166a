using System.Collections.Immutable;
using System.Runtime.ExceptionServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// Draws a scene by following light backwards from the eye, without a GPU: shadows, light between surfaces, mirrors, glass, and faces that
/// shine. The image is noisy at first, and converges as samples are added.
/// </summary>
/// <remarks>
/// Light is that of drawn frames (<see cref="TracedLights"/>), with shadows: the scene's lights are sampled directly at each hit, and the
/// ambient light comes from all directions that no surface hides. Paths end by chance, and go on from up to <see cref="MaxBounces"/>
/// surfaces. Lights with a surface are sampled as well as met (<see cref="TracedLamps"/>). Emissive faces are sampled too, one for each
/// surface (<see cref="TracedAreaLights"/>). In a deep zoom, behind glass, and of infinite or componentwise fractals, their light is found
/// by paths that meet them, which has the same mean and more noise. The same seed gives the same bits on any number of threads.
/// </remarks>
public sealed class PathTracer
{
    /// <summary>Largest number of surfaces that a path of light goes on from. It touches one more.</summary>
    public const int MaxBounces = 8;

    // Parts of a fractal of a smaller radius than so many pixels are traced as one.
    private const double FootprintPixels = 0.25;

    private readonly TracedScene _scene;
    private readonly TracedLights _lights;
    private readonly TracedCamera _camera;
    private readonly LightTransport _light;
    private readonly Scene _declared;
    private readonly Colour _defaultBackground;
    private readonly TracedBackground _background;
    private readonly DisplayTransform _display;
    private readonly int _seed;
    private readonly RadianceImage _image;
    private SharedSamples? _shared;
    private bool _isAffordable;

    /// <summary>Prepares an image without samples.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Pixels, at least 1.</param>
    /// <param name="height">Pixels, at least 1.</param>
    /// <param name="settings">The background where the scene declares none, and the crease angle; the defaults when null.</param>
    /// <param name="seed">Distinguishes independent images.</param>
    /// <exception cref="ArgumentOutOfRangeException">Width or height is less than 1.</exception>
    /// <exception cref="SingularMatrixException">The matrix of an object has no inverse.</exception>
    public PathTracer(LoadedScene scene, View view, int width, int height, RenderSettings? settings = null, int seed = 0)
        : this(
            view, width, height,
            new TracedScene(scene ?? throw new ArgumentNullException(nameof(scene)), settings ?? new()), new(scene),
            TracedBackground.DeclaredIn(scene.Scene, (settings ?? new()).Background), (settings ?? new()).Background, seed)
    {
    }

    private PathTracer(
        View view, int width, int height, TracedScene scene, TracedLights lights, Scene declared, Colour background, int seed)
    {
        ArgumentNullException.ThrowIfNull(view);
        ArgumentOutOfRangeException.ThrowIfLessThan(width, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(height, 1);
        _scene = scene.ForView(view.DeepZoom, view.DeepZoom is null ? view.Section : view.RelativeSection, view.Camera.Position);
        var (eye, unit) = (Vector.Zero, 1.0);
        if (view.DeepZoom is { } zoom)
        {
            (eye, unit) = (view.Camera.Position, Math.Exp(zoom.LogUnit));
            view = view with { Camera = view.Camera with { Position = Vector.Zero } };
        }

        _camera = new(view, width, height, FootprintPixels);
        _lights = lights;
        _declared = declared;
        _defaultBackground = background;
        _display = DisplayTransform.Of(declared);
        _background = new(declared, _display);
        _light = new(_scene, lights, _background, eye, unit)
        {
            FogDensity = unit * (declared.Fog?.Density ?? 0),
            FogColour = LightBlock.FogColour(declared, background),
            Air = declared.Fog is { IsLit: true } fog ? new(fog, lights, _scene, eye, unit) : null,
        };
        _seed = seed;
        Width = width;
        Height = height;
        _image = new(width, height);
    }

    /// <summary>Width of the image in pixels.</summary>
    public int Width { get; }

    /// <summary>Height of the image in pixels.</summary>
    public int Height { get; }

    /// <summary>
    /// Number of surfaces that a path of light goes on from, from 0 to <see cref="MaxBounces"/>; that many unless stated.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative, or larger than that.</exception>
    public int BounceLimit
    {
        get;
        init
        {
            ArgumentOutOfRangeException.ThrowIfNegative(value);
            ArgumentOutOfRangeException.ThrowIfGreaterThan(value, MaxBounces);
            field = value;
        }
    } = MaxBounces;

    /// <summary>Whether what <see cref="Denoise"/> needs is kept: 80 bytes a pixel beside the image's 24. False unless stated.</summary>
    public bool CanDenoise { get; init; }

    /// <summary>How the light of emissive faces is found, to compare.</summary>
    internal AreaLightSampling AreaLightSampling
    {
        init => _scene.Sampling = value;
    }

    /// <summary>Number of samples that every pixel has.</summary>
    public int SampleCount => _image.RowSamples.Min();

    /// <summary>Sentences for the user about textures that can't be decoded, each when its model is prepared.</summary>
    public ImmutableArray<string> Notices => _scene.Notices;

    /// <summary>Prepares an image of another view of the same scene, without samples. What was prepared of the scene is shared.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Pixels, at least 1.</param>
    /// <param name="height">Pixels, at least 1.</param>
    /// <param name="seed">Distinguishes independent images of the same view; null for the seed of this one.</param>
    /// <exception cref="ArgumentOutOfRangeException">Width or height is less than 1.</exception>
    public PathTracer WithView(View view, int width, int height, int? seed = null) =>
        new(view, width, height, _scene, _lights, _declared, _defaultBackground, seed ?? _seed)
        { BounceLimit = BounceLimit, CanDenoise = CanDenoise };

    /// <summary>
    /// Prepares an image of another scene, or of another state of the same one, without samples. What was prepared of models that both
    /// show is shared: textures, normals, and hierarchies for rays.
    /// </summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Pixels, at least 1.</param>
    /// <param name="height">Pixels, at least 1.</param>
    /// <exception cref="ArgumentOutOfRangeException">Width or height is less than 1.</exception>
    /// <exception cref="SingularMatrixException">The matrix of an object has no inverse.</exception>
    public PathTracer WithScene(LoadedScene scene, View view, int width, int height)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return new(
            view, width, height, _scene.WithScene(scene), new(scene), TracedBackground.DeclaredIn(scene.Scene, _defaultBackground),
            _defaultBackground, _seed)
        { BounceLimit = BounceLimit, CanDenoise = CanDenoise };
    }

    /// <summary>Adds one sample to each pixel.</summary>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <param name="scheduler">Owns the threads, beside the calling one; null for those of the pool.</param>
    /// <param name="cancellation">Cancels between two rows; rows then differ by a sample.</param>
    /// <exception cref="OperationCanceledException">The samples were cancelled.</exception>
    /// <exception cref="FractalLimitException">
    /// A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>; or paths take more than
    /// <see cref="FractalLimits.TracedTests"/>.
    /// </exception>
    public void AddSample(int? threads = null, TaskScheduler? scheduler = null, CancellationToken cancellation = default)
    {
        var options = CreateOptions(threads, scheduler, cancellation);
        var sample = SampleCount;
        if (sample == 0 && !_isAffordable)
        {
            PathCost.Check(_camera.Viewport, (x, y, context) => TracePixel(x, y, 0, context, out _, out _), cancellation);
            _isAffordable = true;
        }

        var (_, top, _, height) = _camera.Viewport;
        for (var y = 0; y < Height; y++)
        {
            if (y < top || y >= top + height)
            {
                _image.RowSamples[y] = sample + 1;
            }
        }

        _shared ??= CanDenoise ? new(Width, Height, _camera.Viewport) : null;
        // Rows that share samples are not traced at once.
        var step = _shared is null ? 1 : 3;
        try
        {
            for (var first = 0; first < step; first++)
            {
                var start = top + first;
                Parallel.For(0, (height - first + step - 1) / step, options, static () => new QueryContext(), (index, _, context) =>
                {
                    var y = start + (step * index);
                    if (_image.RowSamples[y] == sample)
                    {
                        AddRow(y, sample, context);
                        _image.RowSamples[y]++;
                    }

                    return context;
                }, static _ => { });
            }
        }
        catch (AggregateException exception) when (exception.InnerException is { } first)
        {
            // Whichever thread was first: each has met the same model.
            ExceptionDispatchInfo.Throw(first);
        }
    }

    /// <summary>Converts the present image to sRGB.</summary>
    public PixelImage ToImage() => ToImage(_image);

    /// <summary>
    /// Converts the present image to sRGB without its noise, as far as neighbouring pixels tell what is noise. The less there is, the
    /// less the image is changed. Without <see cref="CanDenoise"/>, and beyond 4,096 samples, it is that of <see cref="ToImage()"/>.
    /// </summary>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <param name="scheduler">Owns the threads, beside the calling one; null for those of the pool.</param>
    /// <param name="cancellation">Cancels between strips of 16 rows.</param>
    /// <exception cref="OperationCanceledException">The filter was cancelled.</exception>
    /// <remarks>The same bits on any number of threads. Takes 24 bytes a pixel while it runs.</remarks>
    public PixelImage Denoise(int? threads = null, TaskScheduler? scheduler = null, CancellationToken cancellation = default) =>
        ToImage(DenoisedOrRaw(CreateOptions(threads, scheduler, cancellation)));

    /// <summary>Returns the light of the present image, without its noise as <see cref="Denoise"/> does, and further layers.</summary>
    /// <param name="layers">Layers beside the light, which is always there. Without a sample, the light is black.</param>
    /// <param name="cancellation">Cancels between rows.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    /// <remarks>
    /// A lens is taken as a point for all layers but the light. In a deep zoom, depth and position are about the camera in the unit of the
    /// zoom. The same bits on any number of threads. Takes 12 bytes a pixel, and 44 with layers.
    /// </remarks>
    public LightFrame ToLightFrame(IReadOnlyCollection<FrameLayer> layers, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(layers);
        var letterbox = _display.Invert(LetterboxColour.ToLinearVector());
        var light = DenoisedOrRaw(CreateOptions(null, null, cancellation)).ToLight(_camera.Viewport, letterbox);
        return new(light, _declared) { Layers = [.. FindLayers(layers, cancellation)] };
    }

    /// <summary>Finds the channels of layers, all but those of the light. Needs no sample.</summary>
    /// <inheritdoc cref="ToLightFrame"/>
    public IEnumerable<ImageChannel> FindLayers(IReadOnlyCollection<FrameLayer> layers, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(layers);
        if (layers.All(static layer => layer == FrameLayer.Colour))
        {
            return [];
        }

        var found = new SurfaceLayers(_scene, _camera, Width, Height).Find(layers, CreateOptions(null, null, cancellation));
        var counts = Enumerable.Range(0, Width * Height).Select(pixel => (float)_image.RowSamples[pixel / Width]);
        return layers.Contains(FrameLayer.Samples) ? found.Append(new("samples.X", [.. counts])) : found;
    }

    private RadianceImage DenoisedOrRaw(ParallelOptions options)
    {
        if (_shared is not { } shared || SampleCount > SharedSamples.MaxCount)
        {
            return _image;
        }

        var denoised = new RadianceImage(Width, Height);
        new Denoiser(shared, _image).Filter(denoised, options);
        return denoised;
    }

    private Colour LetterboxColour => RenderSettings.LetterboxColour(_declared.Background ?? _defaultBackground);

    /// <summary>The mean radiance of a pixel so far, linear light: red, green, blue.</summary>
    /// <param name="x">From the left, from 0.</param>
    /// <param name="y">From the top, from 0.</param>
    public Vector RadianceAt(int x, int y) => _image.At(x, y);

    private PixelImage ToImage(RadianceImage image) =>
        image.ToImage(_display, _camera.Viewport, LetterboxColour, _background.IsSky);

    private static ParallelOptions CreateOptions(int? threads, TaskScheduler? scheduler, CancellationToken cancellation) => new()
    {
        MaxDegreeOfParallelism = threads ?? Environment.ProcessorCount,
        CancellationToken = cancellation,
        TaskScheduler = scheduler ?? TaskScheduler.Default,
    };

    private void AddRow(int y, int sample, QueryContext context)
    {
        var (left, _, width, _) = _camera.Viewport;
        for (var x = left; x < left + width; x++)
        {
            var radiance = TracePixel(x, y, sample, context, out var point, out var first);
            _image.Add(x, y, radiance);
            _shared?.Add(x, y, sample, TracedCamera.Tent(point.U), TracedCamera.Tent(point.V), radiance, in first);
        }
    }

    private Vector TracePixel(
        int x, int y, int sample, QueryContext context, out (double U, double V) point, out FirstHit first)
    {
        var samples = new SampleSequence((y * Width) + x, sample, _seed);
        point = samples.Next();
        var ray = _camera.CreateRay(x, y, point, out var footprint, out var clip);
        if (_camera.HasLens)
        {
            ray = _camera.ThroughLens(ray, samples.Next(), ref footprint, ref clip);
        }

        var path = new LightPath(ray, footprint, clip);
        return _light.Follow(ref path, BounceLimit, ref samples, context, out first);
    }
}
