using System.Diagnostics;
using FractalEngine.Core.Detail;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Passes;

/// <summary>Chooses the instances of a scene's objects that a picture needs, and keeps them on the GPU until the picture needs others.</summary>
internal sealed class SceneDetail : IDisposable
{
    private readonly ChangeCounter _uploads;
    private readonly DrawableScene _scene;
    private readonly ChosenInstances?[] _instances;
    private readonly int[] _places;
    private readonly DetailObject[] _objects;
    private VisibleSet _chosen = new();
    private VisibleSet _ahead = new();
    private Task? _aheadTask;
    private (DetailView View, DetailSettings Settings, ZoomedObject? Zoom)? _aheadKey;
    private (DetailView View, DetailSettings Settings, ZoomedObject? Zoom)? _last;

    /// <summary>For the objects of a scene that have levels to choose from, and don't move all the time.</summary>
    public SceneDetail(GlResources resources, DrawableScene scene, IReadOnlyDictionary<DrawableModel, ModelBuffers> models)
    {
        (_uploads, _scene) = (resources.Uploads, scene);
        _instances = new ChosenInstances?[scene.Objects.Length];
        _places = new int[scene.Objects.Length];
        var objects = new List<DetailObject>();
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            var model = scene.Objects[i].Model;
            _places[i] = objects.Count;
            if (model.Detail is { } table && !scene.Objects[i].IsMoving)
            {
                _instances[i] = new(resources, scene.Objects[i].Name, models[model], scene.Objects[i].Gradient is not null);
                objects.Add(new(table, scene.Objects[i].Map, model.MeshOrigin, model.MeshSolidSign, !model.HasTransparentParts)
                {
                    Gradient = scene.Objects[i].Gradient?.By ?? GradientKind.None,
                });
            }
        }

        _objects = [.. objects];
    }

    /// <summary>What the last choice took.</summary>
    public DetailCost Cost => _chosen.Cost;

    /// <summary>How many instances were chosen.</summary>
    public int InstanceCount => _chosen.InstanceCount;

    /// <summary>What counted as small, pixels.</summary>
    public double PixelSize => _chosen.PixelSize;

    /// <summary>Triangles of the chosen instances.</summary>
    public long TriangleCount
    {
        get
        {
            var count = 0L;
            for (var i = 0; i < _instances.Length; i++)
            {
                count += _instances[i] is null ? 0 : _chosen.CountOf(_places[i]) * (long)(_scene.Objects[i].Model.Indices.Length / 3);
            }

            return count;
        }
    }

    /// <summary>Bytes of instances that were moved to the GPU so far.</summary>
    public long UploadedBytes => _instances.Sum(instances => instances?.UploadedBytes ?? 0);

    /// <summary>How long the last picture waited for its choice.</summary>
    public TimeSpan WaitedFor { get; private set; }

    /// <summary>How often a choice was made.</summary>
    public int Choices { get; private set; }

    /// <summary>True for an object whose instances are chosen.</summary>
    public bool Has(int index) => _instances[index] is not null;

    /// <summary>Moves an object.</summary>
    public void Move(int index, AffineMap map)
    {
        if (Has(index))
        {
            DropAhead();
            _objects[_places[index]] = _objects[_places[index]] with { Map = map };
            _last = null;
        }
    }

    /// <summary>Chooses and uploads anew, if anything has changed that could change the choice.</summary>
    public void Update(in DetailView view, DetailSettings settings, ZoomedObject? zoom)
    {
        if (_objects.Length == 0 || !_uploads.IsNeeded(_last == (view, settings, zoom), _objects.Length))
        {
            return;
        }

        _last = null;
        var watch = Stopwatch.StartNew();
        if (_aheadKey == (view, settings, zoom))
        {
            _aheadTask!.GetAwaiter().GetResult();
            (_chosen, _ahead, _aheadTask, _aheadKey) = (_ahead, _chosen, null, null);
        }
        else
        {
            DropAhead();
            _chosen.Fill(in view, ObjectsOf(zoom), settings);
        }

        WaitedFor = watch.Elapsed;
        Choices++;
        for (var i = 0; i < _instances.Length; i++)
        {
            _instances[i]?.Upload(_chosen, _places[i]);
        }

        _last = (view, settings, zoom);
    }

    /// <summary>Begins to choose, on other threads, for a picture that is likely to be asked for next.</summary>
    public void Prepare(DetailView view, DetailSettings settings, ZoomedObject? zoom)
    {
        if (_objects.Length == 0 || _last == (view, settings, zoom) || _aheadKey == (view, settings, zoom))
        {
            return;
        }

        DropAhead();
        _aheadKey = (view, settings, zoom);
        var (target, objects) = (_ahead, ObjectsOf(zoom));
        _aheadTask = Task.Run(() => target.Fill(in view, objects, settings));
    }

    /// <summary>Draws the triangles of one material of an object's instances.</summary>
    public void Draw(int index, DrawableBatch batch) => _instances[index]!.Draw(batch);

    /// <summary>The sign of <see cref="DrawableModel.SolidSign"/> where only one side of an object's triangles can be seen.</summary>
    public int SolidSign(int index) => _chosen.IsCut(_places[index]) ? 0 : _scene.Objects[index].Model.SolidSign;

    /// <summary>How a view looks at a picture of some size.</summary>
    public static DetailView ViewOf(View view, int width, int height, double aspect, (double Near, double Far) planes)
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
            planes.Near,
            planes.Far);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        DropAhead();
        foreach (var instances in _instances)
        {
            instances?.Dispose();
        }
    }

    /// <summary>The objects, of which only one is drawn where the camera is deep in it.</summary>
    private DetailObject[] ObjectsOf(ZoomedObject? zoom) => zoom is null ? _objects
        : [.. _objects.Select((item, place) => item with { Roots = place == _places[zoom.Index] ? zoom.Roots : [] })];

    /// <summary>Waits for a choice that nobody asks for any more: its memory, and the objects, can then change.</summary>
    private void DropAhead()
    {
        _aheadTask?.GetAwaiter().GetResult();
        (_aheadTask, _aheadKey) = (null, null);
    }
}
