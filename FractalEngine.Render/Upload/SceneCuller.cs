using System.Diagnostics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Upload;

/// <summary>Culls the instances of a scene's objects, and keeps the visible ones on the GPU until a frame needs others.</summary>
internal sealed class SceneCuller : IDisposable
{
    private static readonly LodHierarchy Empty = LodHierarchy.Build(Mesh.Empty);

    private readonly RedundancyFilter _uploadFilter;
    private readonly DrawableScene _scene;

    // By object; null where all instances are drawn.
    private readonly VisibleInstances?[] _visibleInstances;

    // By object; its index among the culled ones.
    private readonly int[] _culledIndices;
    private readonly CulledObject[] _culledObjects;
    private bool _hasSkyParts;
    private VisibleSet _visible = new();
    private VisibleSet _speculative = new();
    private Task? _speculativeTask;
    private (CullingView View, CullingSettings Settings, DeepZoom? Zoom)? _speculativeKey;
    private (CullingView View, CullingSettings Settings, DeepZoom? Zoom)? _lastKey;

    /// <summary>Creates empty instance buffers for the objects that have a level-of-detail hierarchy and are not dynamic.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="scene">Scene whose instances are culled.</param>
    /// <param name="models">Buffers of its models.</param>
    /// <param name="isLit">Whether colours are drawn: instances come with these, and the parts of the sky that are known by now.</param>
    public SceneCuller(
        GlResources resources, DrawableScene scene, IReadOnlyDictionary<DrawableModel, ModelBuffers> models, bool isLit)
    {
        _uploadFilter = resources.UploadFilter;
        _scene = scene;
        _visibleInstances = new VisibleInstances?[scene.Objects.Length];
        _culledIndices = new int[scene.Objects.Length];
        var culledObjects = new List<CulledObject>();
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            var item = scene.Objects[i];
            var model = item.Model;
            _culledIndices[i] = culledObjects.Count;
            if (model.LodHierarchy is { } hierarchy && !item.IsDynamic)
            {
                var hasSkyMasks = isLit && hierarchy.HasSkyMasks;
                var shading = isLit ? InstanceGradient.CreateOrNull(item.Gradient, hierarchy) : null;
                var gradient = !isLit || (shading is null && item.Gradient is { IsPlain: false }) ? null : item.Gradient;
                var hasTints = gradient is not null;
                var hasMapTints = isLit && hierarchy.HasColours;
                var isSingle = hierarchy.HasNoLevels && !hasTints && !hasSkyMasks && !hasMapTints;
                _visibleInstances[i] = new(
                    resources, item.Name, models[model], isSingle, hasTints, hasSkyMasks, hasMapTints,
                    shading?.Gradient.Palette is not null, isLit && model.HasCoveredSides);
                culledObjects.Add(new(hierarchy, item.Map, model.MeshOrigin, model.MeshWindingSign, !model.IsSeeThrough)
                {
                    GradientKind = gradient?.Kind ?? GradientKind.None,
                    Shading = shading,
                    HasSkyMasks = hasSkyMasks,
                });
            }
        }

        _culledObjects = [.. culledObjects];
    }

    /// <summary>Counts of the last culling pass.</summary>
    public CullingStatistics Statistics => _visible.Statistics;

    /// <summary>Number of visible instances of all objects.</summary>
    public int InstanceCount => _visible.InstanceCount;

    /// <summary>Size in pixels below which a sub-fractal was drawn as one instance.</summary>
    public double MinProjectedSize => _visible.MinProjectedSize;

    /// <summary>Number of triangles of the visible instances.</summary>
    public long TriangleCount => Enumerable.Range(0, _visibleInstances.Length).Where(SelectsInstances)
        .Sum(index => _visible.InstanceCountOf(_culledIndices[index]) * (long)(_scene.Objects[index].Model.Indices.Length / 3));

    /// <summary>Bytes of instances that were uploaded to the GPU so far.</summary>
    public long UploadedBytes => _visibleInstances.Sum(instances => instances?.UploadedBytes ?? 0);

    /// <summary>Time that the drawing thread waited for the last culling pass.</summary>
    public TimeSpan CullWaitTime { get; private set; }

    /// <summary>Number of culling passes so far.</summary>
    public int CullCount { get; private set; }

    /// <summary>Returns true for an object whose visible instances are selected here; all instances of others are drawn.</summary>
    public bool SelectsInstances(int index) => _visibleInstances[index] is not null;

    /// <summary>Returns true for an object whose instances of the last pass come with the parts of the sky that they see.</summary>
    public bool HasSkyParts(int index) => _hasSkyParts && SelectsInstances(index) && _culledObjects[_culledIndices[index]].HasSkyMasks;

    /// <summary>Returns true for an object whose instances come with the sides that are never seen.</summary>
    public bool HasCoveredSides(int index) => SelectsInstances(index) && _scene.Objects[index].Model.HasCoveredSides;

    /// <summary>Moves an object of the scene.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="map">Map from the model's frame to world space.</param>
    public void Move(int index, AffineMap map)
    {
        if (SelectsInstances(index))
        {
            EndSpeculativeCull();
            ref var culledObject = ref _culledObjects[_culledIndices[index]];
            culledObject = culledObject with { ObjectToWorld = map };
            _lastKey = null;
        }
    }

    /// <summary>Includes an object of the scene, or leaves out all of its instances from the next pass on.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="isIncluded">Whether its instances are looked for.</param>
    public void Include(int index, bool isIncluded)
    {
        if (!SelectsInstances(index))
        {
            return;
        }

        ref var culledObject = ref _culledObjects[_culledIndices[index]];
        var hierarchy = isIncluded ? _scene.Objects[index].Model.LodHierarchy! : Empty;
        if (!ReferenceEquals(culledObject.Hierarchy, hierarchy))
        {
            EndSpeculativeCull();
            culledObject = culledObject with { Hierarchy = hierarchy };
            _lastKey = null;
        }
    }

    /// <summary>Culls and uploads the visible instances, unless nothing has changed since the last pass.</summary>
    public void Cull(in CullingView view, CullingSettings settings, DeepZoom? zoom)
    {
        if (_culledObjects.Length == 0 || !_uploadFilter.ShouldPerform(_lastKey == (view, settings, zoom), _culledObjects.Length))
        {
            return;
        }

        _lastKey = null;
        var watch = Stopwatch.StartNew();
        var isAnticipated = _speculativeKey == (view, settings, zoom);
        EndSpeculativeCull();
        if (isAnticipated)
        {
            (_visible, _speculative) = (_speculative, _visible);
        }
        else
        {
            _visible.Cull(in view, CulledObjectsOf(zoom), settings);
        }

        CullWaitTime = watch.Elapsed;
        CullCount++;
        for (var i = 0; i < _visibleInstances.Length; i++)
        {
            _visibleInstances[i]?.Upload(_visible, _culledIndices[i], settings.SkyVisibility);
        }

        _lastKey = (view, settings, zoom);
        _hasSkyParts = settings.SkyVisibility;
    }

    /// <summary>Starts culling on other threads for a frame that will probably be drawn next.</summary>
    public void StartSpeculativeCull(CullingView view, CullingSettings settings, DeepZoom? zoom)
    {
        if (_culledObjects.Length == 0 || _lastKey == (view, settings, zoom) || _speculativeKey == (view, settings, zoom))
        {
            return;
        }

        EndSpeculativeCull();
        _speculativeKey = (view, settings, zoom);
        var target = _speculative;
        var objects = CulledObjectsOf(zoom);
        _speculativeTask = Task.Run(() => target.Cull(in view, objects, settings));
    }

    /// <summary>Draws one batch of an object's visible instances.</summary>
    public void Draw(int index, DrawableBatch batch) => _visibleInstances[index]!.Draw(batch);

    /// <summary>Returns the model's <see cref="DrawableModel.WindingSign"/>, or 0 where the near plane cuts an instance.</summary>
    public int WindingSign(int index) => _visible.IsNearClipped(_culledIndices[index]) ? 0 : _scene.Objects[index].Model.WindingSign;

    /// <inheritdoc/>
    public void Dispose()
    {
        EndSpeculativeCull();
        GlObject.DisposeAll(_visibleInstances);
    }

    /// <summary>Returns the objects to cull. In a deep zoom, only the object that the camera is inside has anything to draw.</summary>
    private CulledObject[] CulledObjectsOf(DeepZoom? zoom) => zoom is null ? _culledObjects
        : [.. _culledObjects.Select((item, index) => item with { Roots = IsInside(zoom.ObjectIndex, index) ? zoom.Roots : [] })];

    /// <summary>Whether a culled object shows the object of the scene with an index.</summary>
    private bool IsInside(int objectIndex, int culledIndex)
    {
        var (first, count) = _scene.ItemsOf(objectIndex).GetOffsetAndLength(_culledIndices.Length);
        return culledIndex >= _culledIndices[first] && culledIndex <= _culledIndices[first + count - 1];
    }

    /// <summary>Waits for the speculative pass, so that its memory and the objects can change.</summary>
    private void EndSpeculativeCull()
    {
        _speculativeTask?.GetAwaiter().GetResult();
        _speculativeTask = null;
        _speculativeKey = null;
    }
}
