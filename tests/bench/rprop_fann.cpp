#include "bench/rprop_fann.h"

#if MROSE_FANN

#include <algorithm>

#include <floatfann.h>

namespace mrose::bench {

namespace {

class Fann : public FannPeer {
public:
    Fann(const PatternRows& rows, int hidden)
        : net_(fann_create_standard(3, rows.inputs, hidden, rows.outputs)),
          data_(fann_create_train(rows.training, rows.inputs, rows.outputs)) {
        // FANN's own defaults are steepness 0.5, a sigmoid output and a tanh-shaped error
        fann_set_activation_function_hidden(net_, FANN_SIGMOID_SYMMETRIC);
        fann_set_activation_function_output(net_, FANN_LINEAR);
        fann_set_activation_steepness_hidden(net_, 1);
        fann_set_activation_steepness_output(net_, 1);
        fann_set_train_error_function(net_, FANN_ERRORFUNC_LINEAR);
        fann_set_training_algorithm(net_, FANN_TRAIN_RPROP);
        fann_randomize_weights(net_, -0.5f, 0.5f);
        const float* from = rows.values.data();
        for (int p = 0; p < rows.training; ++p, from += rows.inputs + rows.outputs) {
            std::copy_n(from, rows.inputs, data_->input[p]);
            std::copy_n(from + rows.inputs, rows.outputs, data_->output[p]);
        }
    }
    Fann(const Fann&) = delete;
    Fann& operator=(const Fann&) = delete;
    ~Fann() override {
        fann_destroy_train(data_);
        fann_destroy(net_);
    }

    void epoch() override { fann_train_epoch(net_, data_); }
    const float* run(float* inputs) override { return fann_run(net_, inputs); }

private:
    fann* net_;
    fann_train_data* data_;
};

}  // namespace

std::unique_ptr<FannPeer> FannPeer::make(const PatternRows& rows, int hidden) {
    return std::make_unique<Fann>(rows, hidden);
}

}  // namespace mrose::bench

#else

namespace mrose::bench {

std::unique_ptr<FannPeer> FannPeer::make(const PatternRows&, int) { return nullptr; }

}  // namespace mrose::bench

#endif
