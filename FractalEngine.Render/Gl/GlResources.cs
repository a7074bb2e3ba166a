using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// Registers the GL objects of one context, alive and pending deletion. GL is called only on the context's thread; an object that is
/// disposed on another thread, or while another context is current, waits here until this one next draws.
/// </summary>
/// <param name="isCurrent">Whether the context is the current one of its thread. GL means no other one by its names.</param>
internal sealed class GlResources(Func<bool> isCurrent)
{
    // More than the programs of one scene.
    private const int MaxIdlePrograms = 64;

    private readonly Lock _lock = new();
    private readonly List<((string Vertex, string Fragment) Sources, int Name)> _idlePrograms = [];
    private readonly HashSet<GlObject> _liveObjects = [];
    private readonly List<GlObject> _pendingDeletion = [];
    private readonly int _threadId = Environment.CurrentManagedThreadId;

    /// <summary>Bindings of the context.</summary>
    public GlState State { get; } = new();

    /// <summary>Counts the uploads of data that changes between frames, and skips redundant ones.</summary>
    public RedundancyFilter UploadFilter { get; } = new();

    /// <summary>True on the thread that may call GL.</summary>
    public bool IsGlThread => Environment.CurrentManagedThreadId == _threadId;

    /// <summary>Kinds and labels of all objects that are not disposed, sorted.</summary>
    public IReadOnlyList<string> LiveObjects
    {
        get
        {
            lock (_lock)
            {
                return [.. _liveObjects.Select(item => item.ToString()).Order(StringComparer.Ordinal)];
            }
        }
    }

    /// <summary>Deletes the objects that were disposed elsewhere, in the context. Costs a lock when there are none.</summary>
    public void DeletePending()
    {
        RequireGlThread();
        lock (_lock)
        {
            foreach (var item in _pendingDeletion)
            {
                item.Delete();
            }

            _pendingDeletion.Clear();
        }
    }

    /// <summary>Deletes all objects, and returns the labels of those that their owners did not dispose.</summary>
    public IReadOnlyList<string> DeleteAll()
    {
        DeletePending();
        var leaks = LiveObjects;
        foreach (var item in _liveObjects.ToArray())
        {
            item.Dispose();
        }

        return leaks;
    }

    /// <summary>
    /// Takes a linked program that its owner has disposed: compiling one takes longer than all else that is needed to show a scene again.
    /// Its uniforms have the values that they had.
    /// </summary>
    /// <param name="sources">Texts of its shaders.</param>
    /// <param name="name">GL's name of the program.</param>
    /// <returns>False where there is none of these sources.</returns>
    public bool TryTakeProgram((string Vertex, string Fragment) sources, out int name)
    {
        var index = _idlePrograms.FindIndex(program => program.Sources == sources);
        name = index < 0 ? 0 : _idlePrograms[index].Name;
        if (index >= 0)
        {
            _idlePrograms.RemoveAt(index);
        }

        return index >= 0;
    }

    /// <summary>Keeps a linked program for others of the same sources, and deletes the oldest one where too many are kept.</summary>
    public void KeepProgram((string Vertex, string Fragment) sources, int name)
    {
        _idlePrograms.Add((sources, name));
        if (_idlePrograms.Count > MaxIdlePrograms)
        {
            State.DeleteProgram(_idlePrograms[0].Name);
            _idlePrograms.RemoveAt(0);
        }
    }

    /// <summary>Turns GL's error flag into an exception.</summary>
    /// <param name="operation">Operation in progress, for the message.</param>
    /// <exception cref="GlException">GL reports an error.</exception>
    public void ThrowOnError(string operation)
    {
        RequireGlThread();
        if (GL.GetError() is var error and not ErrorCode.NoError)
        {
            throw new GlException($"{operation}: OpenGL reports {error}");
        }
    }

    internal void RequireGlThread()
    {
        if (!IsGlThread)
        {
            throw new InvalidOperationException("GL objects can be used on the thread of their context only");
        }
    }

    internal void Add(GlObject item)
    {
        RequireGlThread();
        lock (_lock)
        {
            _liveObjects.Add(item);
        }
    }

    internal void Remove(GlObject item)
    {
        lock (_lock)
        {
            _liveObjects.Remove(item);
            if (!IsGlThread || !isCurrent())
            {
                _pendingDeletion.Add(item);
                return;
            }
        }

        item.Delete();
    }
}
