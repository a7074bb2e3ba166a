using System.Diagnostics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Passes;

/// <summary>
/// Chooses the instances of a scene's objects that a picture needs, and keeps them on the GPU until the picture needs others.
/// </summary>
internal sealed class SceneCuller : IDisposable
{
    private readonly RedundancyFilter _uploadFilter;
    private readonly DrawableScene _scene;
    private readonly VisibleInstances?[] _visibleInstances;
    private readonly int[] _culledIndices;
    private readonly CulledObject[] _culledObjects;
    private VisibleSet _visible = new();
    private VisibleSet _speculative = new();
    private Task? _speculativeTask;
    private (CullingView View, CullingSettings Settings, DeepZoom? Zoom)? _speculativeKey;
    private (CullingView View, CullingSettings Settings, DeepZoom? Zoom)? _lastKey;

    /// <summary>For the objects of a scene that have levels to choose from, and don't move all the time.</summary>
    public SceneCuller(GlResources resources, DrawableScene scene, IReadOnlyDictionary<DrawableModel, ModelBuffers> models)
    {
        (_uploadFilter, _scene) = (resources.UploadFilter, scene);
        _visibleInstances = new VisibleInstances?[scene.Objects.Length];
        _culledIndices = new int[scene.Objects.Length];
        var objects = new List<CulledObject>();
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            var model = scene.Objects[i].Model;
            _culledIndices[i] = objects.Count;
            if (model.LodHierarchy is { } hierarchy && !scene.Objects[i].IsDynamic)
            {
                _visibleInstances[i] = new(resources, scene.Objects[i].Name, models[model], scene.Objects[i].Gradient is not null);
                objects.Add(new(hierarchy, scene.Objects[i].Map, model.MeshOrigin, model.MeshWindingSign, !model.HasTransparentBatches)
                {
                    GradientKind = scene.Objects[i].Gradient?.Kind ?? GradientKind.None,
                });
            }
        }

        _culledObjects = [.. objects];
    }

    /// <summary>What the last choice took.</summary>
    public CullingStatistics Statistics => _visible.Statistics;

    /// <summary>How many instances were chosen.</summary>
    public int InstanceCount => _visible.InstanceCount;

    /// <summary>What counted as small, pixels.</summary>
    public double MinProjectedSize => _visible.MinProjectedSize;

    /// <summary>Triangles of the chosen instances.</summary>
    public long TriangleCount
    {
        get
        {
            var count = 0L;
            for (var i = 0; i < _visibleInstances.Length; i++)
            {
                count += _visibleInstances[i] is null ? 0 : _visible.InstanceCountOf(_culledIndices[i])
                    * (long)(_scene.Objects[i].Model.Indices.Length / 3);
            }

            return count;
        }
    }

    /// <summary>Bytes of instances that were moved to the GPU so far.</summary>
    public long UploadedBytes => _visibleInstances.Sum(instances => instances?.UploadedBytes ?? 0);

    /// <summary>How long the last picture waited for its choice.</summary>
    public TimeSpan CullWaitTime { get; private set; }

    /// <summary>How often a choice was made.</summary>
    public int CullCount { get; private set; }

    /// <summary>True for an object whose instances are chosen.</summary>
    public bool SelectsInstances(int index) => _visibleInstances[index] is not null;

    /// <summary>Moves an object.</summary>
    public void Move(int index, AffineMap map)
    {
        if (SelectsInstances(index))
        {
            DiscardSpeculativeCull();
            _culledObjects[_culledIndices[index]] = _culledObjects[_culledIndices[index]] with { ObjectToWorld = map };
            _lastKey = null;
        }
    }

    /// <summary>Chooses and uploads anew, if anything has changed that could change the choice.</summary>
    public void Update(in CullingView view, CullingSettings settings, DeepZoom? zoom)
    {
        if (_culledObjects.Length == 0 || !_uploadFilter.ShouldPerform(_lastKey == (view, settings, zoom), _culledObjects.Length))
        {
            return;
        }

        _lastKey = null;
        var watch = Stopwatch.StartNew();
        if (_speculativeKey == (view, settings, zoom))
        {
            _speculativeTask!.GetAwaiter().GetResult();
            (_visible, _speculative, _speculativeTask, _speculativeKey) = (_speculative, _visible, null, null);
        }
        else
        {
            DiscardSpeculativeCull();
            _visible.Cull(in view, CulledObjectsOf(zoom), settings);
        }

        CullWaitTime = watch.Elapsed;
        CullCount++;
        for (var i = 0; i < _visibleInstances.Length; i++)
        {
            _visibleInstances[i]?.Upload(_visible, _culledIndices[i]);
        }

        _lastKey = (view, settings, zoom);
    }

    /// <summary>Begins to choose, on other threads, for a picture that is likely to be asked for next.</summary>
    public void StartSpeculativeCull(CullingView view, CullingSettings settings, DeepZoom? zoom)
    {
        if (_culledObjects.Length == 0 || _lastKey == (view, settings, zoom) || _speculativeKey == (view, settings, zoom))
        {
            return;
        }

        DiscardSpeculativeCull();
        _speculativeKey = (view, settings, zoom);
        var (target, objects) = (_speculative, CulledObjectsOf(zoom));
        _speculativeTask = Task.Run(() => target.Cull(in view, objects, settings));
    }

    /// <summary>Draws the triangles of one material of an object's instances.</summary>
    public void Draw(int index, DrawableBatch batch) => _visibleInstances[index]!.Draw(batch);

    /// <summary>The sign of <see cref="DrawableModel.WindingSign"/> where only one side of an object's triangles can be seen.</summary>
    public int WindingSign(int index) => _visible.IsNearClipped(_culledIndices[index]) ? 0 : _scene.Objects[index].Model.WindingSign;

    /// <summary>How a view looks at a picture of some size.</summary>
    public static CullingView ToCullingView(View view, int width, int height, double aspect, (double Near, double Far) clipPlanes)
    {
        var isPerspective = view.Projection == Projection.Perspective;
        return new(
            view.Camera.Position,
            view.Camera.LocalAxes,
            isPerspective,
            isPerspective ? view.Camera.HalfHeightAtUnitDepth : 0.5 * view.OrthographicHeight,
            width,
            height,
            aspect,
            clipPlanes.Near,
            clipPlanes.Far);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        DiscardSpeculativeCull();
        foreach (var instances in _visibleInstances)
        {
            instances?.Dispose();
        }
    }

    /// <summary>The objects, of which only one is drawn where the camera is deep in it.</summary>
    private CulledObject[] CulledObjectsOf(DeepZoom? zoom) => zoom is null ? _culledObjects
        : [.. _culledObjects.Select((item, index) => item with { Roots = index == _culledIndices[zoom.ObjectIndex] ? zoom.Roots : [] })];

    /// <summary>Waits for a choice that nobody asks for any more: its memory, and the objects, can then change.</summary>
    private void DiscardSpeculativeCull()
    {
        _speculativeTask?.GetAwaiter().GetResult();
        (_speculativeTask, _speculativeKey) = (null, null);
    }
}
