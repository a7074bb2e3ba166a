using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Islands;

/// <content>What is copied of bodies, on all threads: searches and contacts read those of many bodies.</content>
internal sealed partial class ContactGraph
{
    private Action<int>? _copyStates;
    private Action<int>? _updateStates;

    // The bodies of which the copy of an earlier step holds as long as they sleep, with how often they had fallen asleep then.
    private (Body? Body, int SleepCount)[] _idleCopies = [];

    /// <summary>True where a body may sleep.</summary>
    private bool HasSleeping { get; set; }

    /// <summary>Copies a group of bodies as they are when their step begins.</summary>
    private void CopyStates(int index)
    {
        var search = _searches[index];
        var (first, end) = BodiesOfSearch(index);
        search.HasSleeping = false;
        search.HasPushed = false;
        var bounds = GridBounds.None;
        for (var i = first; i < end; i++)
        {
            var body = bodies[i];
            search.HasPushed |= body.KinematicPush > 0;
            if (body.IsIdle && _idleCopies[i] == (body, body.SleepCount))
            {
                _states[i].IsTouching = false;
                _states[i].KinematicPush = body.KinematicPush;
                search.HasSleeping = true;
                bounds = bounds.With(_states[i].Position, _states[i].Radius);
                continue;
            }

            if (body.IsIdle || _idleCopies[i].Body is not null)
            {
                _idleCopies[i] = body.IsIdle ? (body, body.SleepCount) : default;
            }

            if (_descriptions[i] != body.Description)
            {
                _descriptions[i] = body.Description;
                _materials[i] = new(body.Description);
            }

            CopyState(body, ref _states[i]);
            search.HasSleeping |= body.IsAsleep;
            bounds = bounds.With(body.Position, body.Radius);
        }

        search.Bounds = bounds;
    }

    private void CopyState(Body body, ref GraphBody state)
    {
        var canMove = CanMove(body);
        var speedGain = canMove ? _stepLength * body.FreeAcceleration.Length() : 0;
        state = new()
        {
            Position = body.Position,
            Radius = body.Radius,
            CanMove = canMove,
            MaySearch = MaySearch(body),
            IsCompound = body.IsCompound,
            IsIdle = body.IsIdle,
            HasHeapMargin = body.HasHeapMargin,
            Rounding = ContactTolerances.Slop(0, body.Position),
            Velocity = body.Velocity,
            SpeedGain = speedGain,
            Slack = (_stepLength * speedGain) + (ReachMargin * body.Radius),
            KinematicPush = body.KinematicPush,
        };
        SetSearchDistance(ref state);
    }

    /// <summary>Copies what has changed of a group of bodies since then, and tells bodies whether they touch others.</summary>
    private void UpdateStates(int index)
    {
        var search = _searches[index];
        var (first, end) = BodiesOfSearch(index);
        search.HasFaster = false;
        search.HasPushed = false;
        for (var i = first; i < end; i++)
        {
            ref var state = ref _states[i];
            if (state.IsIdle && !state.IsTouching && !(state.KinematicPush > 0))
            {
                state.Push = 0;
                state.HasLooked = false;
                search.HasFaster |= IsFaster(in state);
                continue;
            }

            var body = bodies[i];
            body.MayTouchBodies = state.IsTouching || (body.MayTouchBodies && body.IsAsleep);
            state.KinematicPush = body.KinematicPush;
            state.Velocity = body.Velocity;
            state.Reach = state.CanMove ? ReachOf(in state) : 0;
            state.Push = 0;
            state.HasLooked = false;
            search.HasFaster |= IsFaster(in state);
            search.HasPushed |= state.KinematicPush > 0;
        }
    }
}
